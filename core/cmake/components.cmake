# What is built: the layers up to those of SHOAL_COMPONENTS, and a backend for each option.

set(SHOAL_COMPONENTS program CACHE STRING
    "Of formations, scenarios, analysis and program, those to build; each brings those before it")
set(known formations scenarios analysis program)
set(wanted -1)
foreach(component ${SHOAL_COMPONENTS})
  list(FIND known "${component}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "shoal has no component \"${component}\"; SHOAL_COMPONENTS takes ${known}")
  endif()
  if(place GREATER wanted)
    set(wanted ${place})
  endif()
endforeach()
if(wanted EQUAL -1)
  message(FATAL_ERROR "SHOAL_COMPONENTS is empty; it takes ${known}")
endif()
foreach(component ${known})
  list(FIND known ${component} place)
  set(SHOAL_WITH_${component} FALSE)
  if(place LESS_EQUAL wanted)
    set(SHOAL_WITH_${component} TRUE)
  endif()
endforeach()
set(SHOAL_WHOLE ${SHOAL_WITH_program})

# shoal_backend(OPTION "what it is for" SOURCE...): sources that use a library. Without it, the last of
# them is replaced by SOURCE_left_out.cpp, which lists what is then missing.
set(SHOAL_EXCLUDED_SOURCES)
macro(shoal_backend name description)
  option(SHOAL_${name} "Build ${description}" ON)
  foreach(source ${ARGN})
    string(REGEX REPLACE "\\.cpp$" "_left_out.cpp" stand_in ${source})
    if(NOT SHOAL_${name})
      list(APPEND SHOAL_EXCLUDED_SOURCES ${PROJECT_SOURCE_DIR}/${source})
      set(SHOAL_WHOLE FALSE)
    elseif(EXISTS ${PROJECT_SOURCE_DIR}/${stand_in})
      list(APPEND SHOAL_EXCLUDED_SOURCES ${PROJECT_SOURCE_DIR}/${stand_in})
    endif()
  endforeach()
endmacro()

shoal_backend(NLOPT "the solvers of NLopt" solvers/smooth/nlopt.cpp)
shoal_backend(CERES "the solvers of Ceres" solvers/smooth/ceres.cpp)
# CGAL's packages are under the GPL, Ipopt under the EPL, which the FSF holds incompatible with it:
# a binary that is passed on leaves Ipopt out.
shoal_backend(IPOPT "the solvers that use Ipopt" solvers/smooth/ipopt.cpp)
shoal_backend(BOOST "the solver that starts from Boost's Sobol points" solvers/smooth/multistart.cpp)
shoal_backend(CGAL "the selection by CGAL's Delaunay triangulation"
              formations/selections/delaunay.cpp)
shoal_backend(GINAC "potentials from formulas, which GiNaC differentiates" formations/formula.cpp
              formations/formulas/derivatives.cpp formations/formulas/program.cpp
              formations/formulas/tree.cpp formations/potentials/expression.cpp)

# Random numbers are made with Random123, which nothing else needs.
if(NOT SHOAL_WITH_scenarios AND NOT SHOAL_BOOST)
  list(APPEND SHOAL_EXCLUDED_SOURCES ${PROJECT_SOURCE_DIR}/core/random.cpp)
endif()

# The tests compare all members with one another, and drive the program.
include(CMakeDependentOption)
cmake_dependent_option(SHOAL_TESTS "Build the tests and benchmarks" ${PROJECT_IS_TOP_LEVEL}
                       SHOAL_WHOLE OFF)
cmake_dependent_option(SHOAL_PYTHON "Build the Python package" ON SHOAL_WITH_program OFF)
