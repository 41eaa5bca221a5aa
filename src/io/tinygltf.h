#pragma once

// tinygltf with the same settings in every file that includes it: images stay encoded and files are read by our
// callbacks (see gltf_parse.cpp), so it needs neither stb nor the file system.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop
