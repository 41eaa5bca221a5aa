# `cmake --install`: the static layers, the public headers and a package for find_package(probegi).
include(CMakePackageConfigHelpers)

get_property(layers GLOBAL PROPERTY PROBEGI_LAYERS)
foreach(layer ${layers})
    # probegi::core and so on: internal, but the linker needs them.
    string(REPLACE probegi_ "" short ${layer})
    set_target_properties(${layer} PROPERTIES EXPORT_NAME ${short})
endforeach()

# What the public headers themselves need.
find_package(glm REQUIRED)
find_package(tl-expected REQUIRED)
target_link_libraries(probegi INTERFACE glm::glm tl::expected)
target_compile_features(probegi INTERFACE cxx_std_20)

# A header whose library was left out is left out as well.
set(without "")
if(NOT PROBEGI_VULKAN)
    set(without PATTERN vulkan.h EXCLUDE)
endif()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/probegi)
install(TARGETS probegi ${layers} EXPORT probegi_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS probegi_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/probegi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" ${without})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/probegi)
install(EXPORT probegi_targets NAMESPACE probegi:: DESTINATION ${package_folder})

configure_package_config_file(cmake/probegiConfig.cmake.in probegiConfig.cmake INSTALL_DESTINATION ${package_folder}
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(probegiConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/probegiConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/probegiConfigVersion.cmake
    DESTINATION ${package_folder})
