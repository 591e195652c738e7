# cmake --install: headers, archives, programs, examples, tutorials and the package configuration. What a consumer
# sees of it is tested by tests/install.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Signorini)
set(data_folder ${CMAKE_INSTALL_DATADIR}/signorini)

install(TARGETS signorini_surface signorini_solvers signorini EXPORT SignoriniTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS signorini_program signorini_map_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/signorini DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/prm DESTINATION ${data_folder} PATTERN "output*" EXCLUDE)
file(GLOB tutorials CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/doc/tutorial/step-*)
install(DIRECTORY ${tutorials} DESTINATION ${data_folder}/tutorial PATTERN "build*" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/contrib/plots DESTINATION ${data_folder} USE_SOURCE_PERMISSIONS PATTERN "__pycache__" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT SignoriniTargets NAMESPACE Signorini:: DESTINATION ${package_folder})
get_filename_component(SIGNORINI_CHOLMOD_FOLDER ${CHOLMOD_LIBRARY} DIRECTORY)
get_filename_component(SIGNORINI_GMSH_FOLDER ${GMSH_LIBRARY} DIRECTORY)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/SignoriniConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/package/SignoriniConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
# Before 1.0 every minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/SignoriniConfigVersion.cmake
                                 VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/SignoriniConfig.cmake
              ${PROJECT_BINARY_DIR}/package/SignoriniConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/SignoriniDealII.cmake
        DESTINATION ${package_folder})
