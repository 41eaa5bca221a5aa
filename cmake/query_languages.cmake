# query.glsl in other shader languages: BUILD/include/probegi/query.hlsl and query.metal, made by SPIRV-Cross and installed
# beside it.
find_program(SPIRV_CROSS spirv-cross)
if(NOT SPIRV_CROSS)
    message(FATAL_ERROR "probegi/query.hlsl and query.metal need SPIRV-Cross (Debian: spirv-cross). Install it, or leave them "
        "out with -DPROBEGI_QUERY_LANGUAGES=OFF.")
endif()

# probegi_query_language(NAME FLAGS... [GLSLC flags...])
function(probegi_query_language name)
    cmake_parse_arguments(ARG "" "" "FLAGS;GLSLC" ${ARGN})
    set(output ${PROJECT_BINARY_DIR}/include/probegi/${name})
    set(calls ${PROJECT_SOURCE_DIR}/src/vulkan/shaders/languages/query_calls.comp)
    set(spirv ${CMAKE_CURRENT_BINARY_DIR}/languages/${name}.spv)
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/languages)
    # Unoptimised and with names: what comes out is to be read, and its compiler optimises.
    add_custom_command(OUTPUT ${spirv}
        COMMAND ${GLSLC} --target-env=vulkan1.2 -std=460core -O0 -g -Werror -I${PROJECT_SOURCE_DIR}/src
            -I${PROJECT_SOURCE_DIR}/src/vulkan/shaders ${ARG_GLSLC} -MD -MF ${spirv}.d -MT ${spirv} ${calls} -o ${spirv}
        DEPENDS ${calls} DEPFILE ${spirv}.d COMMENT "Compiling query.glsl for ${name}" VERBATIM)
    add_custom_command(OUTPUT ${output}
        COMMAND ${SPIRV_CROSS} ${spirv} ${ARG_FLAGS} --output ${spirv}.txt
        COMMAND ${CMAKE_COMMAND} -DINPUT=${spirv}.txt -DOUTPUT=${output} -DNAME=${name}
            -P ${PROJECT_SOURCE_DIR}/cmake/shader_library.cmake
        DEPENDS ${spirv} ${PROJECT_SOURCE_DIR}/cmake/shader_library.cmake COMMENT "Translating ${name}" VERBATIM)
    string(MAKE_C_IDENTIFIER ${name} target)
    add_custom_target(probegi_shader_include_${target} ALL DEPENDS ${output})
    if(PROBEGI_INSTALL)
        install(FILES ${output} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/probegi)
    endif()
endfunction()

# HLSL has no constant buffers of scalar layout, but byte address buffers of any.
probegi_query_language(query.hlsl FLAGS --hlsl --shader-model 60 GLSLC -DPROBEGI_CONSTANTS_IN_BUFFER)
probegi_query_language(query.metal FLAGS --msl --msl-version 20100 --msl-force-native-arrays)
