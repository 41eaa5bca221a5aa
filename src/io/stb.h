#pragma once

// stb with the same settings in every file that includes it.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65536
#define STBI_WRITE_NO_STDIO
#include <stb_image.h>
#include <stb_image_write.h>
