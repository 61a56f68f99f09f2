# Headers are included as "shoal/core/angles.hpp", in the tree as when installed.
set(SHOAL_INCLUDE ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${SHOAL_INCLUDE}/shoal)
foreach(layer core solvers formations scenarios analysis)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${layer} ${SHOAL_INCLUDE}/shoal/${layer} SYMBOLIC)
endforeach()

add_library(shoal_warnings INTERFACE)
target_compile_options(shoal_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wnon-virtual-dtor -Wno-missing-field-initializers
                       $<$<BOOL:${SHOAL_WERROR}>:-Werror>
                       # At -O3 these of GCC 12 report code of Eigen and of libstdc++ itself
                       # (GCC bug 105651 and its like); the sanitizers look for the real thing.
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-array-bounds
                       -Wno-maybe-uninitialized -Wno-stringop-overflow -Wno-stringop-overread
                       # A source of a unity build counts as a header, in which no class may have
                       # members of an anonymous namespace's types.
                       $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-subobject-linkage>>)

# shoal_precompile(TARGET HEADER...): headers that most sources of the target include, read once. In a
# unity build they are, without this.
function(shoal_precompile target)
  if(NOT CMAKE_UNITY_BUILD)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    # What ccache needs to know such a source again.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()

# shoal_library(LAYER PUBLIC ... PRIVATE ...): every .cpp of the layer, as a shared library.
#
# Shared, because members register themselves at start-up: out of a static library the linker would
# drop every file that is not called by name. It also keeps the solvers' libraries out of what a
# user of shoal links.
function(shoal_library layer)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${layer}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/(program|tools|python)/")
  list(REMOVE_ITEM sources ${SHOAL_EXCLUDED_SOURCES})
  add_library(shoal_${layer} SHARED ${sources})
  add_library(shoal::${layer} ALIAS shoal_${layer})
  set_target_properties(shoal_${layer} PROPERTIES EXPORT_NAME ${layer} VERSION ${PROJECT_VERSION}
                        SOVERSION ${PROJECT_VERSION_MAJOR})
  target_include_directories(shoal_${layer} PUBLIC $<BUILD_INTERFACE:${SHOAL_INCLUDE}>
                             $<INSTALL_INTERFACE:include>)
  target_compile_features(shoal_${layer} PUBLIC cxx_std_20)
  # What a backend's static library brings stays inside: a user may link another version of it.
  target_link_options(shoal_${layer} PRIVATE LINKER:--exclude-libs,ALL)
  # A program may know members by name only: its linker must not drop the library for that.
  target_link_options(shoal_${layer} INTERFACE LINKER:--no-as-needed)
  # Neither changes a number: square roots need not set errno, and no one asks for floating-point traps.
  target_compile_options(shoal_${layer} PRIVATE -fno-semantic-interposition -fno-math-errno
                         -fno-trapping-math)
  target_link_libraries(shoal_${layer} ${ARGN} PRIVATE $<BUILD_INTERFACE:shoal_warnings>)
  shoal_precompile(shoal_${layer} <shoal/core/registry.hpp>)
endfunction()
