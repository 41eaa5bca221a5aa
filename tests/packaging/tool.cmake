# cmake -DPROBEGI=folder -DWORK=folder -DOPTIONS=-Da=b|... -P tool.cmake
# Builds the tool without the Vulkan backend, and tries to use it.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
run(${CMAKE_COMMAND} -S ${PROBEGI} -B ${WORK} -G Ninja -DPROBEGI_VULKAN=OFF -DPROBEGI_TESTS=OFF -DPROBEGI_BENCH=OFF ${OPTIONS})
run(${CMAKE_COMMAND} --build ${WORK} --target probegi_tool)
execute_process(COMMAND ${WORK}/apps/probegi/probegi devices RESULT_VARIABLE code ERROR_VARIABLE said)
if(NOT code EQUAL 1 OR NOT said MATCHES "without its Vulkan backend")
    message(FATAL_ERROR "a tool without Vulkan ended with ${code}: ${said}")
endif()
