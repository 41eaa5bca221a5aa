// The one place where stb is compiled: only the formats that ProbeGI reads and writes, no file access of its own.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include "io/stb.h"
