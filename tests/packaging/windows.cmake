# cmake -DPROBEGI=folder -DWORK=folder -DOPTIONS=-Da=b|... -DCOMPILER=mingw's -DWINE=program -DNATIVE=program
# -DGLM=include folder -DHIGHWAY=include folder -P windows.cmake
# Cross-compiles engine/ for Windows and compares its example's output under Wine with the native one's.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
if(NOT COMPILER OR NOT WINE)
    message(FATAL_ERROR "needs g++-mingw-w64-x86-64-posix and wine64: scripts/setup.sh test")
endif()

# Header-only libraries are portable: links to them in a folder with nothing else of this machine.
file(MAKE_DIRECTORY ${WORK}/headers)
file(CREATE_LINK ${GLM}/glm ${WORK}/headers/glm SYMBOLIC)
file(CREATE_LINK ${HIGHWAY}/hwy ${WORK}/headers/hwy SYMBOLIC)
foreach(package glm::glm)
    string(REGEX REPLACE "::.*" "" name ${package})
    file(WRITE ${WORK}/packages/${name}Config.cmake "add_library(${package} INTERFACE IMPORTED)
set_target_properties(${package} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${WORK}/headers)\n")
endforeach()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/engine -B ${WORK}/build -G Ninja -DPROBEGI_FOLDER=${PROBEGI} ${OPTIONS}
    -DPROBEGI_HIGHWAY_FOLDER=${WORK}/headers
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_EXE_LINKER_FLAGS=-static -DCMAKE_PREFIX_PATH=${WORK}/packages)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${CMAKE_COMMAND} -E chdir ${WORK} ${NATIVE})
set(native "${output}")
# Silences Wine's own messages, and keeps its registry in our folder.
set(ENV{WINEPREFIX} ${WORK}/wine)
set(ENV{WINEDEBUG} -all)
run(${CMAKE_COMMAND} -E chdir ${WORK} ${WINE} wineboot --init)
run(${CMAKE_COMMAND} -E chdir ${WORK} ${WINE} ${WORK}/build/examples/own_tracer.exe)
string(REPLACE "\r" "" output "${output}")
if(NOT output STREQUAL native)
    message(FATAL_ERROR "the program for Windows says\n${output}\nand the native one\n${native}")
endif()
