# cmake -DPROBEGI=folder -DWORK=folder -DOPTIONS=-Da=b|... "-DEXAMPLES=a|b with arguments" -P engine.cmake
# Configures engine/ with the options, builds it, runs its program and the examples.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/engine -B ${WORK} -G Ninja -DPROBEGI_FOLDER=${PROBEGI} ${OPTIONS})
run(${CMAKE_COMMAND} --build ${WORK})
run(${WORK}/parts)
foreach(example ${EXAMPLES})
    separate_arguments(arguments UNIX_COMMAND "${example}")
    run(${CMAKE_COMMAND} -E chdir ${WORK} ${WORK}/examples/${arguments})
endforeach()
