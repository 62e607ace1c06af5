# What `cmake --install` puts where: the library with its headers and CMake package, the command line, the licence.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS laterna EXPORT laternaTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/laterna DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(TARGETS laterna_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET laterna_ffmpeg)
  install(TARGETS laterna_ffmpeg LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/laterna)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The command finds the library beside it, wherever the two are moved to.
file(RELATIVE_PATH library_from_command ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(laterna_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_command}")

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/laterna)
configure_package_config_file(cmake/laternaConfig.cmake.in ${PROJECT_BINARY_DIR}/laternaConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
# Before 1.0 every minor version may break what the one before promised.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/laternaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/laternaConfig.cmake ${PROJECT_BINARY_DIR}/laternaConfigVersion.cmake
        DESTINATION ${package_folder})
install(EXPORT laternaTargets NAMESPACE laterna:: DESTINATION ${package_folder})
