// run.nc as `shoal report` reads it. series.nc is another file of the same reader.

#include "fuzzed.hpp"
#include "shoal/analysis/reporting/recorded_run.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  tests::fuzzed_file("series.nc", input);
  analysis::read_recorded_run(tests::fuzzed_file("run.nc", input).parent_path());
}
