#pragma once

// stb with the same settings in every file that includes it. It reads Radiance .hdr only: fuzzing makes its JPEG reader
// write beyond its Huffman tables, and its PNG reader unpacks everything in a file before checking it.
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65536
#define STBI_WRITE_NO_STDIO
#include <stb_image.h>
#include <stb_image_write.h>
