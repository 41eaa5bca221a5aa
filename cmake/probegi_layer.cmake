# One static library per folder of src/, so that dependencies point one way:
# a layer sees the headers of the layers that it names, and no others are linked.

add_library(probegi_options INTERFACE)
# Highway would compile for AVX-512 twice, with and without instructions that nothing here uses.
target_compile_definitions(probegi_options INTERFACE HWY_DISABLED_TARGETS=HWY_AVX3_DL)
if(NOT MSVC)
    target_compile_options(probegi_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
endif()
if(PROBEGI_WERROR)
    target_compile_options(probegi_options INTERFACE $<IF:$<CXX_COMPILER_ID:MSVC>,/WX,-Werror>)
endif()
if(PROBEGI_NATIVE AND NOT MSVC)
    target_compile_options(probegi_options INTERFACE -march=native)
elseif(NOT MSVC)
    # What every x86 processor since 2009 has; the hot loops choose better instructions when they run.
    include(CheckCXXCompilerFlag)
    check_cxx_compiler_flag(-march=x86-64-v2 PROBEGI_COMPILES_X86_64_V2)
    if(PROBEGI_COMPILES_X86_64_V2)
        target_compile_options(probegi_options INTERFACE -march=x86-64-v2)
    endif()
endif()
if(PROBEGI_SANITIZE)
    target_compile_options(probegi_options INTERFACE -fsanitize=${PROBEGI_SANITIZE} -fno-omit-frame-pointer -g1)
    target_link_options(probegi_options INTERFACE -fsanitize=${PROBEGI_SANITIZE})
endif()

# probegi_layer(NAME [WITHOUT names...] [ONLY names...] [LAYERS lower layers...] [LIBRARIES external libraries...])
# compiles every .cpp of the calling folder into the static library probegi_NAME: but for those whose name begins with
# one of WITHOUT, or only those that begin with one of ONLY.
function(probegi_layer name)
    cmake_parse_arguments(ARG "" "" "WITHOUT;ONLY;LAYERS;LIBRARIES" ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    foreach(without ${ARG_WITHOUT})
        list(FILTER sources EXCLUDE REGEX "/${without}[^/]*$")
    endforeach()
    if(ARG_ONLY)
        list(JOIN ARG_ONLY "|" only)
        list(FILTER sources INCLUDE REGEX "/(${only})[^/]*$")
    endif()
    add_library(probegi_${name} STATIC ${sources})
    target_include_directories(probegi_${name}
        PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
        PRIVATE ${PROJECT_SOURCE_DIR}/src)
    # The same objects go into the static and into the shared library, which shows PROBEGI_API only.
    set_target_properties(probegi_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    if(WIN32 AND BUILD_SHARED_LIBS)
        target_compile_definitions(probegi_${name} PRIVATE PROBEGI_BUILDS_SHARED)
    endif()
    target_link_libraries(probegi_${name} PRIVATE $<BUILD_INTERFACE:probegi_options>)
    target_link_libraries(probegi_${name} PUBLIC glm::glm)
    foreach(layer ${ARG_LAYERS})
        target_link_libraries(probegi_${name} PUBLIC probegi_${layer})
    endforeach()
    target_link_libraries(probegi_${name} PRIVATE ${ARG_LIBRARIES})
    set_property(GLOBAL APPEND PROPERTY PROBEGI_LAYERS probegi_${name})
endfunction()
