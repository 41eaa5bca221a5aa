# `cmake --install`: the library (the shared one, or the static layers), the public headers and a package for
# find_package(probegi).
include(CMakePackageConfigHelpers)

if(BUILD_SHARED_LIBS)
    set(libraries probegi)
else()
    get_property(layers GLOBAL PROPERTY PROBEGI_LAYERS)
    foreach(layer ${layers})
        # probegi::core and so on: internal, but the linker needs them.
        string(REPLACE probegi_ "" short ${layer})
        set_target_properties(${layer} PROPERTIES EXPORT_NAME ${short})
    endforeach()
    set(libraries probegi ${layers})
endif()

# Headers of libraries that were not built are not installed.
set(without "")
if(NOT PROBEGI_VULKAN)
    list(APPEND without PATTERN vulkan.h EXCLUDE PATTERN vulkan EXCLUDE)
endif()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/probegi)
install(TARGETS ${libraries} EXPORT probegi_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(PROBEGI_TOOL)
    file(RELATIVE_PATH to_libraries /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
    set_target_properties(probegi_tool PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
    install(TARGETS probegi_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY include/probegi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" ${without})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/probegi)
install(EXPORT probegi_targets NAMESPACE probegi:: DESTINATION ${package_folder})

configure_package_config_file(cmake/probegiConfig.cmake.in probegiConfig.cmake INSTALL_DESTINATION ${package_folder}
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(probegiConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/probegiConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/probegiConfigVersion.cmake
    DESTINATION ${package_folder})
