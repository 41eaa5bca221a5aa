# Tests that need a Vulkan device. Each is registered for every driver there is: the system's (a GPU's, or software with
# ray query), and the older software driver without ray query that scripts/setup.sh unpacks.

# The driver's own description of itself names no folder: the loader wants one that does.
set(older_driver_file "")
file(GLOB older_driver ${PROJECT_SOURCE_DIR}/build/mesa-22.3/usr/lib/*/libvulkan_lvp.so)
if(older_driver)
    set(older_driver_file ${PROJECT_BINARY_DIR}/mesa-22.3.json)
    file(CONFIGURE OUTPUT ${older_driver_file} @ONLY CONTENT [[
{"file_format_version": "1.0.0", "ICD": {"library_path": "@older_driver@", "api_version": "1.3.230"}}
]])
endif()

# probegi_vulkan_test(NAME [LIBRARIES ...] [LABELS ...]): probegi_test() with testDevice() of support/vulkan_device.h. Its
# tests run on the older driver as well, named mesa22.NAME..., except for those with RayQuery or rayQuery in their name.
function(probegi_vulkan_test name)
    cmake_parse_arguments(ARG "" "" "LIBRARIES;LABELS" ${ARGN})
    probegi_test(${name} LIBRARIES Vulkan::Vulkan ${ARG_LIBRARIES} LABELS vulkan ${ARG_LABELS})
    target_sources(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/vulkan_device.cpp)
    if(older_driver_file)
        gtest_discover_tests(test_${name} TEST_PREFIX mesa22.${name}. TEST_FILTER "-*RayQuery*:*rayQuery*"
            TEST_LIST test_${name}_mesa22 DISCOVERY_TIMEOUT 60
            PROPERTIES TIMEOUT 600 ENVIRONMENT VK_DRIVER_FILES=${older_driver_file} LABELS mesa22)
    endif()
endfunction()
