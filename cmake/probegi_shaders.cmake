# Embeds compute shaders in a library, so that there are no files to find at run time.

find_package(Vulkan 1.3 QUIET)
find_program(GLSLC glslc)
if(NOT Vulkan_FOUND OR NOT GLSLC)
    message(FATAL_ERROR "The Vulkan backend needs the Vulkan headers, 1.3 or newer, and glslc (Debian: libvulkan-dev glslc). "
        "Install them, or leave the backend out with -DPROBEGI_VULKAN=OFF.")
endif()
set(PROBEGI_GLSLC_FLAGS --target-env=vulkan1.2 -std=460core -O -Werror -I${PROJECT_SOURCE_DIR}/src -I${PROJECT_SOURCE_DIR}/include)

# Compiles one shader to a list of words for a C initialiser; further arguments go to glslc. Appends to the caller's
# `words`, `entries` and `outputs`.
function(probegi_shader_variant shader name)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/shaders/${name}.inc)
    add_custom_command(OUTPUT ${output}
        COMMAND ${GLSLC} ${PROBEGI_GLSLC_FLAGS} ${ARGN} -mfmt=num -MD -MF ${output}.d -MT ${output} ${shader} -o ${output}
        DEPENDS ${shader} DEPFILE ${output}.d COMMENT "Compiling shader ${name}" VERBATIM)
    set(words "${words}constexpr std::uint32_t k_${name}[] = {\n#include \"shaders/${name}.inc\"\n};\n" PARENT_SCOPE)
    set(entries "${entries}        Entry{\"${name}\", k_${name}},\n" PARENT_SCOPE)
    set(outputs ${outputs} ${output} PARENT_SCOPE)
endfunction()

# probegi_shaders(TARGET BOOK [FOLDER folder] [TRACERS folder/tracer_NAME.glsl...]) compiles shaders (GLSL 4.60, no
# #version line; quoted includes are looked for beside the shader, in src/ and in include/) and adds the function BOOK, a ShaderBook
# (src/vulkan/device/shader_code.h), to the target:
# - each FOLDER/SHADER.comp, as "SHADER";
# - each shader of src/vulkan/shaders with the line `// variants: tracers`, once for each of TRACERS, as "SHADER_NAME".
#   They include "chosen_tracer.glsl", which the build generates: it includes the tracer's file.
function(probegi_shaders target book)
    cmake_parse_arguments(ARG "" "FOLDER" "TRACERS" ${ARGN})
    set(words "")
    set(entries "")
    set(outputs "")
    set(shaders "")
    if(ARG_FOLDER)
        file(GLOB shaders CONFIGURE_DEPENDS ${ARG_FOLDER}/*.comp)
    endif()
    file(GLOB passes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/vulkan/shaders/*.comp)
    foreach(shader ${passes})
        # The variants depend on a line of the shader, so CMake must run again if it changes.
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${shader})
        file(STRINGS ${shader} traces REGEX "^// variants: tracers$" LIMIT_COUNT 1)
        if(NOT traces)
            continue()
        endif()
        list(REMOVE_ITEM shaders ${shader})
        cmake_path(GET shader STEM pass)
        foreach(tracer ${ARG_TRACERS})
            cmake_path(GET tracer FILENAME file)
            cmake_path(GET tracer PARENT_PATH beside)
            if(NOT file MATCHES "^tracer_([a-z0-9_]+)[.]glsl$")
                message(FATAL_ERROR "${tracer} is not a tracer; its name must be tracer_NAME.glsl")
            endif()
            set(name ${CMAKE_MATCH_1})
            set(chosen ${CMAKE_CURRENT_BINARY_DIR}/shaders/${name})
            file(CONFIGURE OUTPUT ${chosen}/chosen_tracer.glsl CONTENT "#include \"@file@\"\n" @ONLY)
            probegi_shader_variant(${shader} ${pass}_${name} -I${chosen} -I${beside})
        endforeach()
    endforeach()
    foreach(shader ${shaders})
        cmake_path(GET shader STEM name)
        probegi_shader_variant(${shader} ${name})
    endforeach()
    list(LENGTH outputs count)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/shader_code.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/${book}.cpp @ONLY)
    # A separate object library, so that shaders need not wait for the layers below the target.
    add_library(${target}_shaders OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${book}.cpp ${outputs})
    target_include_directories(${target}_shaders PRIVATE ${CMAKE_CURRENT_BINARY_DIR} ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target}_shaders PRIVATE probegi_options)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_shaders>)
endfunction()

# probegi_shader_include(INPUT NAME) merges a shader's source and all its includes into one file for engines' shaders:
# BUILD/include/NAME, installed as include/NAME, which needs no include path of its own.
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
        # Also made now: if an engine adds this folder, its shaders do not declare a dependency on the file.
        execute_process(COMMAND ${collect} COMMAND_ERROR_IS_FATAL ANY)
    endif()
    add_custom_command(OUTPUT ${output} COMMAND ${collect}
        DEPENDS ${included} ${PROJECT_SOURCE_DIR}/cmake/amalgamate.cmake COMMENT "Collecting ${name}" VERBATIM)
    add_custom_target(probegi_shader_include_${stem} ALL DEPENDS ${output})
    if(PROBEGI_INSTALL)
        install(FILES ${output} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
    endif()
endfunction()
