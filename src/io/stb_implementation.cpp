// Compiles stb: only the formats that ProbeGI reads and writes, without file access.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include "io/stb.h"
