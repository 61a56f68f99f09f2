# cmake -DSOURCE=... -DOUTPUT=... -P source_id.cmake: writes what the sources are into OUTPUT, which
# changes only when they do. Tables and claims do not belong to it: they only read what is stored.
file(GLOB_RECURSE sources RELATIVE ${SOURCE}
     ${SOURCE}/core/*.?pp ${SOURCE}/solvers/*.?pp ${SOURCE}/formations/*.?pp ${SOURCE}/scenarios/*.?pp
     ${SOURCE}/analysis/experiments/measure.?pp ${SOURCE}/analysis/experiments/measures/*.?pp
     ${SOURCE}/analysis/experiments/trial.?pp)
list(SORT sources)
set(all "")
foreach(source ${sources})
  file(SHA256 ${SOURCE}/${source} hash)
  string(APPEND all "${source} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)

set(commit unknown)
set(dirty false)
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse HEAD OUTPUT_VARIABLE found
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit ${found})
    execute_process(COMMAND ${GIT} -C ${SOURCE} status --porcelain --untracked-files=no
                    OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(changes)
      set(dirty true)
    endif()
  endif()
endif()

set(text "constexpr const char* source_hash = \"${hash}\";
constexpr const char* source_commit = \"${commit}\";
constexpr bool source_dirty = ${dirty};
")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT "${text}" STREQUAL "${before}")
  file(WRITE ${OUTPUT} "${text}")
endif()
