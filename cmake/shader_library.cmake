# cmake -DINPUT=file -DOUTPUT=file -DNAME=query.hlsl|query.metal -P shader_library.cmake
# Turns a translation of src/vulkan/shaders/languages/query_calls.comp into an include: takes out the entry point and its
# buffer, and lets the including shader choose the registers.
cmake_minimum_required(VERSION 3.25)
file(READ ${INPUT} text)
# CMake's lists are separated by semicolons, which brackets protect; the text is one string all along.
string(REGEX REPLACE "\n(void comp_main|kernel void main0)\\(.*$" "" text "${text}")
string(REGEX REPLACE "\nRWByteAddressBuffer probegiCalls[^\n]*" "" text "${text}")
string(REGEX REPLACE "\nstruct ProbegiCalls\n{[^}]*}[^\n]*\n" "" text "${text}")
string(REGEX REPLACE "\n(static const|constant) uint3 gl_WorkGroupSize[^\n]*" "" text "${text}")
string(REGEX REPLACE "register\\(([a-z])([0-9]), space0\\)" "register(PROBEGI_JOIN(\\1, PROBEGI_BINDING_\\2), PROBEGI_SPACE)" text "${text}")
if(text MATCHES "probegiCalls|gl_WorkGroupSize|space0")
    message(FATAL_ERROR "SPIRV-Cross' output has changed: something of the entry point is left in ${NAME}")
endif()

set(about "// probegi/query.glsl, translated by SPIRV-Cross: see the comments of that file for what the functions do.\n")
if(NAME STREQUAL "query.hlsl")
    string(APPEND about "//
//     #define PROBEGI_SPACE space1  // the descriptor set, and the four bindings in it, that you passed to
//     #define PROBEGI_BINDING_0 3   // GpuField::queryBindings(), with QueryConstants::storageBuffer
//     #define PROBEGI_BINDING_1 4   // by default: space0, 0, 1, 2, 3
//     #define PROBEGI_BINDING_2 5
//     #define PROBEGI_BINDING_3 6
//     #include \"probegi/query.hlsl\"
//     ...
//     float3 e = probegiIrradiance(position, normal, toViewer);
//
// Shader model 6.0.
#ifndef PROBEGI_SPACE
#define PROBEGI_SPACE space0
#endif
#ifndef PROBEGI_BINDING_0
#define PROBEGI_BINDING_0 0
#define PROBEGI_BINDING_1 1
#define PROBEGI_BINDING_2 2
#define PROBEGI_BINDING_3 3
#endif
#define PROBEGI_PASTE(kind, binding) kind##binding
#define PROBEGI_JOIN(kind, binding) PROBEGI_PASTE(kind, binding)
")
else()
    string(APPEND about "//
// Metal Shading Language 2.1. A function takes what it reads after its own arguments, in the order of their declarations
// below: constants, states, atlases with their samplers; probegiIrradiance has all of them.
")
endif()
set(guard "PROBEGI_QUERY_TRANSLATED")
file(WRITE ${OUTPUT} "${about}#ifndef ${guard}\n#define ${guard}\n${text}\n#endif\n")
