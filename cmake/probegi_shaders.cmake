# Compute shaders as part of a library: no files to find at run time.

find_package(Vulkan 1.3 QUIET)
find_program(GLSLC glslc)
if(NOT Vulkan_FOUND OR NOT GLSLC)
    message(FATAL_ERROR "The Vulkan backend needs the Vulkan headers, 1.3 or newer, and glslc (Debian: libvulkan-dev glslc). "
        "Install them, or leave the backend out with -DPROBEGI_VULKAN=OFF.")
endif()
set(PROBEGI_GLSLC_FLAGS --target-env=vulkan1.2 -std=460core -O -Werror -I${PROJECT_SOURCE_DIR}/src)

# One shader to one list of words, as the inside of a C initialiser. Appends to `words` and `entries` of the caller.
function(probegi_shader_variant shader name)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/shaders/${name}.inc)
    list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE definitions)
    add_custom_command(OUTPUT ${output}
        COMMAND ${GLSLC} ${PROBEGI_GLSLC_FLAGS} ${definitions} -mfmt=num -MD -MF ${output}.d -MT ${output} ${shader} -o ${output}
        DEPENDS ${shader} DEPFILE ${output}.d COMMENT "Compiling shader ${name}" VERBATIM)
    set(words "${words}constexpr std::uint32_t k_${name}[] = {\n#include \"shaders/${name}.inc\"\n};\n" PARENT_SCOPE)
    set(entries "${entries}        Shader{\"${name}\", k_${name}},\n" PARENT_SCOPE)
    set(outputs ${outputs} ${output} PARENT_SCOPE)
endfunction()

# probegi_shaders(TARGET FOLDER) compiles every FOLDER/NAME.comp (GLSL 4.60, no #version line; quoted includes are looked
# for beside it and in src/) and adds the definition of shaderCode() (src/vulkan/device/shader_code.h) to the target:
# shaderCode("NAME"). A shader with a line
#     // variants: bvh=TRACER_BVH ray_query=TRACER_RAY_QUERY,ANOTHER_MACRO=2
# is compiled once for each of them, with these macros: shaderCode("NAME_bvh").
function(probegi_shaders target folder)
    file(GLOB shaders CONFIGURE_DEPENDS ${folder}/*.comp)
    set(words "")
    set(entries "")
    set(outputs "")
    foreach(shader ${shaders})
        cmake_path(GET shader STEM stem)
        # The names of the variants stand in the shader: another line means another build.
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${shader})
        file(STRINGS ${shader} variants REGEX "^// variants:" LIMIT_COUNT 1)
        string(REGEX REPLACE "^// variants:[ ]*" "" variants "${variants}")
        separate_arguments(variants)
        if(NOT variants)
            probegi_shader_variant(${shader} ${stem})
        endif()
        foreach(variant ${variants})
            if(NOT variant MATCHES "^([a-z0-9_]+)=(.+)$")
                message(FATAL_ERROR "${shader}: '${variant}' is not a variant; write name=MACRO[,MACRO...]")
            endif()
            string(REPLACE "," ";" macros "${CMAKE_MATCH_2}")
            probegi_shader_variant(${shader} ${stem}_${CMAKE_MATCH_1} ${macros})
        endforeach()
    endforeach()
    list(LENGTH outputs count)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/shader_code.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/shader_code.cpp @ONLY)
    # Objects of their own, so that shaders do not wait for the layers below the target.
    add_library(${target}_shaders OBJECT ${CMAKE_CURRENT_BINARY_DIR}/shader_code.cpp ${outputs})
    target_include_directories(${target}_shaders PRIVATE ${CMAKE_CURRENT_BINARY_DIR} ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target}_shaders PRIVATE probegi_options)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_shaders>)
endfunction()

# probegi_shader_include(INPUT NAME) makes one file of a shader's source and all that it includes, for the shaders of
# engines: BUILD/include/NAME, installed as include/NAME, which needs no include path of its own.
function(probegi_shader_include input name)
    set(output ${PROJECT_BINARY_DIR}/include/${name})
    cmake_path(GET name PARENT_PATH folder)
    cmake_path(GET input PARENT_PATH beside)
    cmake_path(GET input STEM stem)
    file(GLOB included CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/kernels/*.h
        ${PROJECT_SOURCE_DIR}/src/kernels/*/*.h ${beside}/*.glsl)
    set(collect ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DROOT=${PROJECT_SOURCE_DIR}/src
        -P ${PROJECT_SOURCE_DIR}/cmake/amalgamate.cmake)
    if(NOT EXISTS ${output})
        # There from the beginning: shaders of an engine that adds this folder name no dependency on it.
        execute_process(COMMAND ${collect} COMMAND_ERROR_IS_FATAL ANY)
    endif()
    add_custom_command(OUTPUT ${output} COMMAND ${collect}
        DEPENDS ${included} ${PROJECT_SOURCE_DIR}/cmake/amalgamate.cmake COMMENT "Collecting ${name}" VERBATIM)
    add_custom_target(probegi_shader_include_${stem} ALL DEPENDS ${output})
    if(PROBEGI_INSTALL)
        install(FILES ${output} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
    endif()
endfunction()
