// Compiles tinygltf. Its writer uses std::ofstream even with TINYGLTF_NO_FS.
#include <fstream>
#define TINYGLTF_IMPLEMENTATION
#include "io/tinygltf.h"
