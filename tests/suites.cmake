# One ctest test per suite of a GoogleTest program, not per test: tests of one suite share a process and so the pipelines
# that drivers compile for it, which takes software Vulkan longer than most tests.
#
# probegi_suites(PROGRAM PREFIX FILTER LABELS ENVIRONMENT) registers PREFIX.SUITE for each suite that FILTER leaves tests of.
# FILTER is GoogleTest's; what it has before its minus names whole suites. Run as a script, after PROGRAM is built, this
# file writes the list that ctest reads.

if(NOT CMAKE_SCRIPT_MODE_FILE)
    function(probegi_suites program prefix filter labels environment)
        set(list ${CMAKE_CURRENT_BINARY_DIR}/${prefix}.cmake)
        add_custom_command(TARGET ${program} POST_BUILD BYPRODUCTS ${list} VERBATIM
            COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${program}> -DPREFIX=${prefix} "-DFILTER=${filter}" "-DLABELS=${labels}"
                "-DENVIRONMENT=${environment}" -DLIST=${list} -P ${PROJECT_SOURCE_DIR}/tests/suites.cmake)
        # Before the program is built, a test that fails: it must not be overlooked.
        file(CONFIGURE OUTPUT ${prefix}_include.cmake @ONLY CONTENT
            "if(EXISTS \"@list@\")\n  include(\"@list@\")\nelse()\n  add_test(@prefix@_NOT_BUILT @prefix@_NOT_BUILT)\nendif()\n")
        set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${prefix}_include.cmake)
    endfunction()
    return()
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -E env ${ENVIRONMENT} ${PROGRAM} --gtest_list_tests --gtest_filter=${FILTER}
    OUTPUT_VARIABLE listed RESULT_VARIABLE result TIMEOUT 60)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} cannot list its tests: ${result}")
endif()
# Suites begin their lines and end in a dot; tests are indented.
string(REGEX MATCHALL "(^|\n)[^ \n]+\\.( |\n)" suites "${listed}")
string(REGEX MATCH "-.*$" except "${FILTER}")
set(tests "")
foreach(suite ${suites})
    string(STRIP "${suite}" suite)
    string(REGEX REPLACE "\\.$" "" suite "${suite}")
    string(APPEND tests "add_test([==[${PREFIX}.${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*${except}]==])\n"
        "set_tests_properties([==[${PREFIX}.${suite}]==] PROPERTIES TIMEOUT 1800 LABELS [==[${LABELS}]==] "
        "ENVIRONMENT [==[${ENVIRONMENT}]==] SKIP_REGULAR_EXPRESSION [==[\\[  SKIPPED |DISABLED TEST]==])\n")
endforeach()
if(NOT tests)
    message(FATAL_ERROR "${PROGRAM} has no tests that match ${FILTER}")
endif()
file(WRITE ${LIST} "${tests}")
