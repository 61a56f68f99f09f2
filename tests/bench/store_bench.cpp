// What the store of a study costs: writing a trial, and tables and merges of 100,000 of them.

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/study_tables.hpp"
#include "shoal/analysis/experiments/store/manifest.hpp"
#include "shoal/analysis/experiments/store/merge.hpp"
#include "shoal/analysis/experiments/store/planned_trial.hpp"
#include "shoal/analysis/experiments/store/store.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"
#include "shoal/analysis/reporting/export.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

/// 4 behaviours x 25 periods x 1000 replications.
const char* const study_text = R"(
scenario = "construction_square"
replications = 1000
[[factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "pairwise_referencing", "attraction_repulsion", "assignment_registration"]
[[factor]]
key = "ping.period_s"
range = [5, 125]
steps = 25
)";
const char* const a_table = R"(
[[table]]
name = "all"
rows = ["period_s"]
columns = ["behaviour"]
measures = ["energy_mean_wh", "quality_settled_m", "efficiency_m_per_wh"]
)";
/// Beside it: 225 tests of 1000 differences each.
const char* const its_best = "best = \"lowest\"\ncompare = \"behaviour\"\n";

TrialList list(const std::string& tables = a_table) {
  return TrialList(read_study(scenarios::parse_toml(study_text + tables, "study.toml")));
}

/// A trial with every measure that there is, and numbers that were not simulated.
StoredTrial trial(const TrialList& list, std::size_t i) {
  const ListedTrial& planned = list.trial(i);
  StoredTrial made = planned_trial(list, planned);
  made.scenario = "0d3cba0f-0e03-5bbc-a66e-" + std::to_string(planned.cell);
  made.id = "06f80130-aaf3-55d0-9bd5-" + std::to_string(i);
  made.program = "bench";
  made.wall_s = 1.0;
  double number = static_cast<double>(i % 997) + 0.125 * static_cast<double>(planned.cell);
  for (const Quantity& quantity : known_values()) {
    made.measures.emplace_back(quantity.name, number);
    number = number * 1.37 + 1.0 / 3.0;
  }
  return made;
}

scenarios::Series series(int instants) {
  scenarios::Series made{"quality", "m", "how good", {}, {}};
  for (int k = 0; k < instants; ++k) {
    made.time_s.push_back(30.0 * k);
    made.values.push_back(1.0 / (1 + k));
  }
  return made;
}

/// A folder that goes with the program.
class Folder {
 public:
  explicit Folder(const char* name)
      : path_(fs::temp_directory_path() / (name + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// One of `parts` folders with 100,000 trials between them.
void fill(const fs::path& folder, int part, int parts) {
  const TrialList all = list();
  write_study(all, folder);
  Manifest(all, folder).begin_sweep({});
  Store store(folder, Store::Access::write);
  store.together([&] {
    for (const std::size_t i : all.part(part, parts)) store.write(trial(all, i));
  });
}

const fs::path& big_store() {
  static const Folder folder("shoal_bench_store_");
  static const bool filled = (fill(folder.path(), 1, 1), true);
  (void)filled;
  return folder.path();
}

/// As a sweep stores a trial: in a transaction of its own. `series` numbers against time with it.
void store_write(benchmark::State& state) {
  const Folder folder("shoal_bench_write_");
  const TrialList all = list();
  Store store(folder.path(), Store::Access::write);
  std::size_t i = 0;
  for (auto _ : state) {
    StoredTrial made = trial(all, i++ % all.trials());
    if (state.range(0) > 0) made.series.push_back(series(static_cast<int>(state.range(0))));
    store.write(made);
  }
}
BENCHMARK(store_write)->Arg(0)->Arg(600)->Unit(benchmark::kMillisecond);

void tabulate(benchmark::State& state, const std::string& tables) {
  const fs::path& folder = big_store();
  for (auto _ : state) {
    const StudyResults results = read_results(list(tables), folder);
    std::size_t letters = 0;
    for (const Table& table : study_tables(results)) {
      letters += as_latex(table).size();
    }
    benchmark::DoNotOptimize(letters);
  }
}
void tabulate_100000(benchmark::State& state) {
  tabulate(state, a_table);
}
BENCHMARK(tabulate_100000)->Unit(benchmark::kSecond);
void tabulate_100000_best_by(benchmark::State& state, const char* test) {
  tabulate(state, std::string(a_table) + its_best + "test = \"" + test + "\"\n");
}
BENCHMARK_CAPTURE(tabulate_100000_best_by, paired_t, "paired_t")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(tabulate_100000_best_by, sign_flip, "sign_flip")->Unit(benchmark::kSecond);

void export_100000(benchmark::State& state) {
  const Folder out("shoal_bench_export_");
  for (auto _ : state) {
    const StudyExport exported(big_store());
    exported.write_netcdf(out.path() / "study.nc");
    benchmark::DoNotOptimize(exported.csv().size());
  }
}
BENCHMARK(export_100000)->Unit(benchmark::kSecond);

void merge_100000(benchmark::State& state) {
  const Folder one("shoal_bench_part1_"), two("shoal_bench_part2_"), out("shoal_bench_merged_");
  fill(one.path(), 1, 2);
  fill(two.path(), 2, 2);
  for (auto _ : state) {
    merge(out.path() / "merged", {one.path(), two.path()});
    state.PauseTiming();
    fs::remove_all(out.path() / "merged");
    state.ResumeTiming();
  }
}
BENCHMARK(merge_100000)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace shoal::analysis
