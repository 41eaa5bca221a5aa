#pragma once

// stb with the same settings in every file that includes it. Its JPEG reader is left out: the fuzzer makes it write
// beyond its Huffman tables, and libjpeg-turbo does not.
#define STBI_ONLY_PNG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65536
#define STBI_WRITE_NO_STDIO
#include <stb_image.h>
#include <stb_image_write.h>
