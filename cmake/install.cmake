include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(layers core solvers formations scenarios analysis)
foreach(layer ${layers})
  list(APPEND targets shoal_${layer})
  install(DIRECTORY ${layer}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/shoal/${layer}
          FILES_MATCHING PATTERN "*.hpp")
endforeach()

install(TARGETS ${targets} EXPORT shoal LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS shoal_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${SHOAL_LIBRARY_DIR}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/shoal/library)
install(EXPORT shoal NAMESPACE shoal:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/shoal)

configure_package_config_file(cmake/shoalConfig.cmake.in ${PROJECT_BINARY_DIR}/shoalConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/shoal)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/shoalConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/shoalConfig.cmake ${PROJECT_BINARY_DIR}/shoalConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/shoal)
