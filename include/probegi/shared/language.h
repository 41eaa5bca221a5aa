// What lets one text of a struct be C++20 and GLSL 4.60. All members are made of 4 bytes, so that C++ and GLSL's scalar
// layout place them alike, without gaps.
#ifndef PROBEGI_SHARED_LANGUAGE_H
#define PROBEGI_SHARED_LANGUAGE_H

#ifdef __cplusplus

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#define PROBEGI_SHARED_BEGIN namespace probegi {
#define PROBEGI_SHARED_END }
#define PROBEGI_VEC2 glm::vec2
#define PROBEGI_VEC3 glm::vec3
#define PROBEGI_INT std::int32_t
#define PROBEGI_UINT std::uint32_t
#define PROBEGI_CONST inline constexpr
#define PROBEGI_DEFAULT(value) = value

#else  // GLSL

#define PROBEGI_SHARED_BEGIN
#define PROBEGI_SHARED_END
#define PROBEGI_VEC2 vec2
#define PROBEGI_VEC3 vec3
#define PROBEGI_INT int
#define PROBEGI_UINT uint
#define PROBEGI_CONST const
#define PROBEGI_DEFAULT(value)

#endif

#endif
