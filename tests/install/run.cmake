# cmake -DBUILD=... -DEXAMPLES=... -DWORK=... -DCOMPILER=... -DLAUNCHER=... -DSANITIZE=... -DVERSION=... -DVULKAN=...
# [-DFILM="FRAMES HEIGHT"] -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../packaging/common.cmake)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${WORK}/prefix/bin/probegi --help)

set(flags "-Wall -Wextra -Werror")
if(SANITIZE)
    string(APPEND flags " -fsanitize=${SANITIZE}")
endif()
# Copies the sources, so that nothing of this tree can be used by accident.
file(COPY ${EXAMPLES}/ DESTINATION ${WORK}/source)
run(${CMAKE_COMMAND} -S ${WORK}/source -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_CXX_FLAGS=${flags})
run(${CMAKE_COMMAND} --build ${WORK}/build)
set(examples own_tracer first_light engine_loop moving_door "fog 90")
if(VULKAN)
    list(APPEND examples "vulkan_engine ${FILM}")
endif()
foreach(example ${examples})
    separate_arguments(arguments UNIX_COMMAND "${example}")
    run(${CMAKE_COMMAND} -E chdir ${WORK}/build ${WORK}/build/${arguments})
endforeach()
