# cmake -DPROBEGI=folder -DWORK=folder -DOPTIONS=-Da=b|... -P shared.cmake
# Builds everything with one shared library and checks the symbols that it exports.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
run(${CMAKE_COMMAND} -S ${PROBEGI} -B ${WORK} -G Ninja -DBUILD_SHARED_LIBS=ON -DPROBEGI_TESTS=OFF -DPROBEGI_BENCH=OFF
    ${OPTIONS})
run(${CMAKE_COMMAND} --build ${WORK})
run(nm --demangle --dynamic --defined-only ${WORK}/src/libprobegi.so)
foreach(shown "probegi::Field::create(" "probegi::poseAt(" "typeinfo for probegi::Tracer")
    string(FIND "${output}" "${shown}" at)
    if(at EQUAL -1)
        message(FATAL_ERROR "the shared library does not show ${shown}")
    endif()
endforeach()
string(FIND "${output}" "probegi::parallelFor" at)
string(FIND "${output}" "probegi::queryIrradiance(" within)
if(NOT at EQUAL -1 OR NOT within EQUAL -1)
    message(FATAL_ERROR "the shared library shows what is not in its public headers")
endif()
