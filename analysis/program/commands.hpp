#pragma once

#include <string>
#include <vector>

namespace shoal::program {

struct RunArguments {
  std::string scenario;
  std::vector<std::string> sets;
  std::string seed;  ///< as written; empty: the scenario's own
  std::string out;
  int threads = 1;
  bool report = true;
  std::string problems;     ///< file for the problems posed; empty: do not record them
  std::size_t keep = 1000;  ///< of them, for each vehicle
};

struct CorpusArguments {
  std::string file;
  double duration_s = 1800.0;
  int keep = 150;
  std::string seed = "1";
};

struct SolveArguments {
  std::string corpus;
  std::vector<std::string> solvers;
  std::vector<std::string> sets;
  std::string reference;
  double same_within_m = 0.01;
  std::string format = "text";
  std::string profiles;
};

struct SweepArguments {
  std::string study;
  std::string out;
  int jobs = 1;
  std::string shard;
  std::int64_t replications = 0;  ///< 0: as the study says
  std::string dask;  ///< address of a scheduler, whose workers run the trials; "" for none
  int batch = 1;     ///< trials that such a worker takes at a time
  bool fail_fast = false, rerun_changed = false, retry_failed = false;
  bool figures = true;
};

// Each command prints to stdout, throws InputError or SystemError, and knows nothing of CLI11.
void run(const RunArguments& arguments);
void list(const std::string& family);
/// Whether it is what list() lists, in the singular or the plural.
bool is_listed(const std::string& family);
void describe(const std::string& name_or_key);
void check(const std::vector<std::string>& files);
void corpus(const CorpusArguments& arguments);
void solve(const SolveArguments& arguments);
void eval(const std::string& model, const std::string& file);
void sweep(const SweepArguments& arguments);
void merge(const std::string& folder, const std::vector<std::string>& others);
void export_study(const std::string& folder, const std::string& out);
void tables(const std::string& folder, bool summary);
void claims(const std::string& folder);
void report(const std::string& folder);
/// Becomes Python, which takes the same arguments.
void figures(const std::vector<std::string>& arguments);
/// What Python draws them by.
std::string figures_package();
/// Draws all figures of a folder in a child process, whose errors are shown: whether it succeeded.
bool figures_drawn(const std::string& folder);

}  // namespace shoal::program
