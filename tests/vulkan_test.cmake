# Tests that need a Vulkan device. Each names the drivers that it runs on, so that no result depends on what else the
# machine has. scripts/setup.sh installs the software ones:
#   NAME...         software with ray query (Mesa 25.0, or the system's)
#   mesa22.NAME...  software without ray query (Mesa 22.3); not the tests of ray query
#   gpu.NAME...     this machine's GPU, if it has one; tests of ray query only if the GPU supports it
#   both.NAME...    the two software drivers in one list, for tests of lists of devices

# Driver manifests for the loader, by path: it would take two drivers with the same library name for one.
function(describe_driver result name)
    set(${result} "" PARENT_SCOPE)
    file(GLOB libraries ${ARGN})
    if(libraries)
        list(GET libraries 0 library)
        set(description ${PROJECT_BINARY_DIR}/${name}.json)
        file(CONFIGURE OUTPUT ${description} @ONLY CONTENT [[
{"file_format_version": "1.0.0", "ICD": {"library_path": "@library@", "api_version": "1.3.230"}}
]])
        set(${result} ${description} PARENT_SCOPE)
    endif()
endfunction()

describe_driver(older_driver_file mesa-22.3 ${PROJECT_SOURCE_DIR}/build/mesa-22.3/usr/lib/*/libvulkan_lvp.so)
describe_driver(software_driver_file mesa-25.0 ${PROJECT_SOURCE_DIR}/build/mesa-25.0/usr/lib/*/libvulkan_lvp.so)
if(NOT software_driver_file)
    describe_driver(software_driver_file software /usr/lib/*/libvulkan_lvp.so /usr/lib64/libvulkan_lvp.so)
endif()
# Environment of every test, including those of the tool and the examples. Without such a driver, the system's choice.
set(software_driver "")
set(on_software "")
if(software_driver_file)
    set(software_driver VK_DRIVER_FILES=${software_driver_file})
    set(on_software ENVIRONMENT ${software_driver})
endif()

# The system's GPUs: whether any can be used, and whether all of them have ray query.
set(gpu_environment "VK_LOADER_DRIVERS_DISABLE=*lvp_icd*")
function(look_for_gpu)
    set(gpu_answers OFF PARENT_SCOPE)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env "${gpu_environment}" vulkaninfo --summary OUTPUT_VARIABLE summary
        ERROR_QUIET TIMEOUT 60)
    if(NOT summary MATCHES
            "apiVersion[^\n]*[^0-9.]1\\.([3-9]|1[0-9])\\.[^:]*PHYSICAL_DEVICE_TYPE_(DISCRETE|INTEGRATED|VIRTUAL)_GPU")
        return()
    endif()
    execute_process(COMMAND ${CMAKE_COMMAND} -E env "${gpu_environment}" vulkaninfo OUTPUT_VARIABLE all ERROR_QUIET TIMEOUT 60)
    string(REGEX MATCHALL "deviceType" devices "${summary}")
    string(REGEX MATCHALL "VK_KHR_ray_query " rayQueries "${all}")
    list(LENGTH devices devices)
    list(LENGTH rayQueries rayQueries)
    set(gpu_answers ON PARENT_SCOPE)
    set(gpu_without_ray_query ON PARENT_SCOPE)
    if(rayQueries EQUAL devices)
        set(gpu_without_ray_query OFF PARENT_SCOPE)
    endif()
    message(STATUS "Tests run on the GPU as well, ray query on ${rayQueries} of ${devices} devices")
endfunction()
look_for_gpu()

# On other drivers than the first, tests that do not use a Vulkan device are not run again.
set(tests_without_device "*/cpu:*/embree:*/embreeMovable")
set(tests_of_ray_query "*RayQuery*:*rayQuery*")

# on_driver(NAME PREFIX FILTER ENVIRONMENT) registers the tests of test_NAME again.
function(on_driver name prefix filter environment)
    probegi_suites(test_${name} ${prefix}.${name} "${filter}" ${prefix} "${environment}")
endfunction()

# probegi_vulkan_test(NAME [LIBRARIES ...] [LABELS ...]): probegi_test() with testDevice() of support/vulkan_device.h, on
# every driver.
function(probegi_vulkan_test name)
    cmake_parse_arguments(ARG "" "" "LIBRARIES;LABELS" ${ARGN})
    probegi_test(${name} LIBRARIES Vulkan::Vulkan ${ARG_LIBRARIES} LABELS vulkan ${ARG_LABELS})
    target_sources(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/vulkan_device.cpp)
    if(older_driver_file)
        on_driver(${name} mesa22 "*-${tests_of_ray_query}:${tests_without_device}" VK_DRIVER_FILES=${older_driver_file})
    endif()
    if(gpu_answers AND gpu_without_ray_query)
        on_driver(${name} gpu "*-${tests_of_ray_query}:${tests_without_device}" ${gpu_environment})
    elseif(gpu_answers)
        on_driver(${name} gpu "*-${tests_without_device}" ${gpu_environment})
    endif()
endfunction()
