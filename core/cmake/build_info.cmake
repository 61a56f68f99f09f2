# What analysis/experiments/build_info.cpp tells manifests: the sources, looked at in every build, and the
# libraries as they were found.
set(source_id ${PROJECT_BINARY_DIR}/generated/source_id.inc)
add_custom_target(shoal_source_id BYPRODUCTS ${source_id}
                  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${source_id}
                          -P ${CMAKE_CURRENT_LIST_DIR}/source_id.cmake
                  COMMENT "" VERBATIM)
add_dependencies(shoal_analysis shoal_source_id)
target_include_directories(shoal_analysis PRIVATE ${PROJECT_BINARY_DIR}/generated)

set(built_with "Eigen ${Eigen3_VERSION}" "Boost ${Boost_VERSION_STRING}" "oneTBB ${TBB_VERSION}"
               "netCDF ${netCDF_VERSION}" "SQLite ${SQLite3_VERSION}")
foreach(backend "NLOPT NLopt ${NLOPT_VERSION}" "CERES Ceres ${Ceres_VERSION}"
                "IPOPT Ipopt ${IPOPT_VERSION}" "CGAL CGAL ${CGAL_VERSION}"
                "GINAC GiNaC ${GINAC_VERSION}")
  string(REGEX MATCH "^([A-Z]+) (.*)$" parts ${backend})
  if(SHOAL_${CMAKE_MATCH_1})
    list(APPEND built_with ${CMAKE_MATCH_2})
  endif()
endforeach()
string(JOIN "|" built_with ${built_with})
set_source_files_properties(
  analysis/experiments/build_info.cpp PROPERTIES COMPILE_DEFINITIONS "SHOAL_BUILT_WITH=\"${built_with}\"")
