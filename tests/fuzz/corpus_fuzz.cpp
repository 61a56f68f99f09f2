// Recorded problems as `shoal solve` reads and solves them.

#include "fuzzed.hpp"
#include "shoal/analysis/benchmarking/solver_comparison.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  const auto corpus = analysis::read_corpus(tests::fuzzed_file("problems.jsonl", input));
  analysis::SolverComparison comparison(
      {.solvers = {"newton", "procrustes", "sampled"}, .reference = {}, .options = {}});
  comparison.run(corpus);
}
