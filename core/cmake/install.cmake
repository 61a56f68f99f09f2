include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Headers that programs and plugins build on; what only sources of shoal include stays inside.
set(internal_headers
    "/(program|python|reporting|benchmarking)/"
    "/experiments/([a-z]+/|pipeline\\.hpp)" "/statistics/([a-ce-z]|d[a-df-z]|designs)" "/tables/[^t]"
    "/smooth/(attempt|minimum)\\.hpp$" "/descent\\.hpp$"
    "/matching/(assignment|lattice|paired|points|pose|rigid|rotation|slot)[a-z_]*\\.hpp$"
    "/netcdf_[a-z]*\\.hpp$" "/(mission_time|whole_times)\\.hpp$" "/nps_auv/" "/formula(s/[a-z]+)?\\.hpp$")
if(${PROJECT_SOURCE_DIR}/core/random.cpp IN_LIST SHOAL_EXCLUDED_SOURCES)
  list(APPEND internal_headers "/core/random\\.hpp$")
endif()
foreach(pattern ${internal_headers})
  list(APPEND exclude_internal REGEX ${pattern} EXCLUDE)
endforeach()
set(layers core solvers formations)
foreach(layer scenarios analysis)
  if(SHOAL_WITH_${layer})
    list(APPEND layers ${layer})
  endif()
endforeach()
foreach(layer ${layers})
  list(APPEND targets shoal_${layer})
  install(DIRECTORY ${layer}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/shoal/${layer}
          FILES_MATCHING PATTERN "*.hpp" ${exclude_internal})
endforeach()

install(TARGETS ${targets} EXPORT shoal LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(SHOAL_WITH_program)
  install(TARGETS shoal_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${SHOAL_LIBRARY_DIR}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/shoal/library)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(EXPORT shoal NAMESPACE shoal:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/shoal)

list(JOIN layers ", " SHOAL_INSTALLED)
configure_package_config_file(core/cmake/shoalConfig.cmake.in ${PROJECT_BINARY_DIR}/shoalConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/shoal)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/shoalConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/shoalConfig.cmake ${PROJECT_BINARY_DIR}/shoalConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/shoal)
