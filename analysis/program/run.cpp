#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "shoal/analysis/benchmarking/problem_recorder.hpp"
#include "shoal/analysis/experiments/named_files.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/analysis/reporting/run_report.hpp"
#include "shoal/core/error.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {
namespace {

void print_wrapped(std::string line, const std::vector<std::string>& words) {
  constexpr std::size_t width = 100;
  for (const std::string& word : words) {
    if (line.size() + 1 + word.size() > width) {
      fmt::print("{}\n", line);
      line = "   ";
    }
    line += " " + word;
  }
  fmt::print("{}\n", line);
}

void print_summary(const analysis::Trial& trial, const std::string& name) {
  fmt::print("{}: {}, {} vehicles, {:g} s (ended by {}), seed {}\n", name,
             trial.scenario.behaviour.kind(), trial.world->size(), trial.world->time_s(),
             trial.world->stopped_by(), trial.scenario.trial.seed);
  std::vector<std::string> without;
  for (const auto& [measure, value] : trial.results.values) {
    if (value) {
      fmt::print("  {:<30} {:>12.6g}\n", measure, *value);
    } else {
      without.push_back(measure);
    }
  }
  if (!without.empty()) print_wrapped("  never, or not of this trial:", without);
  fmt::print("simulated in {:.2f} s, {:.3g} vehicle-seconds per second\n", trial.wall_s,
             trial.vehicle_seconds_per_wall_s());
}

/// Takes away folders that were not there before, if nothing was written into them.
class NewFolders {
 public:
  explicit NewFolders(const std::filesystem::path& folder) {
    std::error_code unknown;  // then it is left alone
    auto path = std::filesystem::absolute(folder);
    for (; !std::filesystem::exists(path, unknown) && !unknown; path = path.parent_path()) {
      new_.push_back(path);
    }
  }
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  ~NewFolders() {
    std::error_code ignored;  // they are not empty
    for (const auto& path : new_) std::filesystem::remove(path, ignored);
  }

 private:
  std::vector<std::filesystem::path> new_;  // the innermost first
};

void require_own_name(const std::filesystem::path& problems, const std::filesystem::path& out) {
  const auto whole = [](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
  };
  for (const char* name : analysis::run_files) {
    if (whole(problems) != whole(out / name)) continue;
    throw InputError("--record-problems: " + problems.string() +
                     " is a file of the run itself; give the problems another name");
  }
}

}  // namespace

void run(const RunArguments& arguments) {
  const std::filesystem::path file = analysis::scenario_file(arguments.scenario);
  Setting root = scenarios::read_toml(file);
  for (const std::string& set : arguments.sets) scenarios::apply_set(root, set);
  if (!arguments.seed.empty()) scenarios::apply_set(root, "trial.seed=" + arguments.seed);

  const scenarios::Scenario scenario = scenarios::read_scenario(root);
  const std::string name = file.stem().string();
  const std::filesystem::path out = arguments.out.empty() ? "out/" + name : arguments.out;
  const std::filesystem::path problems = arguments.problems;
  if (!problems.empty()) require_own_name(problems, out);
  const NewFolders folders(out);
  analysis::require_writable(out);
  analysis::ProblemRecorder recorder(arguments.keep);
  analysis::TrialSettings settings{.threads = arguments.threads, .record = true};
  if (!problems.empty()) {
    analysis::require_writable_file(arguments.problems);
    settings.plan_observer = recorder.of_trial();
  }

  const analysis::Trial trial = analysis::run_trial(scenario, settings);
  analysis::write_trial(trial, name, out);
  print_summary(trial, name);
  // A report is made of what was written, which a pipe or a device does not give back.
  const bool report =
      arguments.report && std::ranges::none_of(analysis::run_files, [&](const char* written) {
        return written != std::string_view("report.html") &&
               std::filesystem::is_other(out / written);
      });
  if (report) {
    for (const std::string& note : analysis::write_run_report(out)) fmt::print("{}\n", note);
  } else if (arguments.report) {
    fmt::print("no report: {} holds a pipe or a device, which cannot be read back\n", out.string());
  }
  if (!problems.empty()) {
    const analysis::Corpus corpus = recorder.corpus(scenario, name, trial.world->plan());
    analysis::write_corpus(corpus, problems);
    const std::size_t kept = corpus.situations.size(), all = recorder.situations();
    fmt::print("written: {}, {}{} situations in which problems were posed\n", problems.string(),
               kept, kept < all ? fmt::format(" of {}", all) : "");
  }
  fmt::print("written: {}/{{scenario.toml,{}summary.json{}}}\n", out.string(),
             trial.record ? "run.nc,series.nc," : "", report ? ",report.html" : "");
}

}  // namespace shoal::program
