# The Python package shoal, as it stands in the build tree (python/shoal) and, installed, where the
# chosen Python looks.

# Debian's own python3, not one that stands before it in PATH: it sees the Debian packages.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python 3 with the Debian packages")
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter OPTIONAL_COMPONENTS Development.Module)
# Where Debian's Python looks below a prefix of your own.
set(SHOAL_PYTHON_DIR "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/dist-packages"
    CACHE STRING "Where the Python package is installed, below the prefix")
if(SHOAL_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
  # pybind11 takes what was found, and does not look for one of its own.
  set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE} CACHE FILEPATH "" FORCE)
  set(PYBIND11_PYTHON_VERSION ${Python3_VERSION})
  find_package(pybind11 2.10 REQUIRED)
  message(STATUS "Python module for ${Python3_EXECUTABLE} (${Python3_VERSION})")

  set(package ${PROJECT_BINARY_DIR}/python/shoal)
  set(package_source ${PROJECT_SOURCE_DIR}/analysis/python/shoal)
  file(GLOB binding_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/analysis/python/*.cpp
       ${PROJECT_SOURCE_DIR}/analysis/python/members/*.cpp)
  pybind11_add_module(shoal_python NO_EXTRAS ${binding_sources})
  # Visible, unlike what pybind11 sets: there is one registry of a family, not one here and one there.
  set_target_properties(shoal_python PROPERTIES OUTPUT_NAME _shoal CXX_VISIBILITY_PRESET default
                        VISIBILITY_INLINES_HIDDEN OFF LIBRARY_OUTPUT_DIRECTORY ${package})
  target_link_libraries(shoal_python PRIVATE shoal::analysis shoal_warnings)

  # Links, so that a changed file need not be built.
  file(GLOB_RECURSE package_files CONFIGURE_DEPENDS RELATIVE ${package_source}
       ${package_source}/*.py ${package_source}/*.pyi ${package_source}/py.typed)
  file(MAKE_DIRECTORY ${package})
  foreach(file ${package_files})
    file(CREATE_LINK ${package_source}/${file} ${package}/${file} SYMBOLIC)
  endforeach()

  file(RELATIVE_PATH to_libraries ${CMAKE_INSTALL_PREFIX}/${SHOAL_PYTHON_DIR}/shoal
       ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(shoal_python PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
  install(TARGETS shoal_python LIBRARY DESTINATION ${SHOAL_PYTHON_DIR}/shoal)
  install(DIRECTORY ${package_source}/ DESTINATION ${SHOAL_PYTHON_DIR}/shoal
          PATTERN __pycache__ EXCLUDE)
endif()
