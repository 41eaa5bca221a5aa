# Included by the scripts beside it and by install/run.cmake.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
    message(STATUS "${output}")
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "failed with ${code}: ${ARGN}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()
# Lists are passed with | between the entries.
string(REPLACE "|" ";" OPTIONS "${OPTIONS}")
string(REPLACE "|" ";" EXAMPLES "${EXAMPLES}")
file(REMOVE_RECURSE ${WORK})
