#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "commands.hpp"
#include "named_files.hpp"
#include "python.hpp"
#include "shoal/analysis/experiments/results/study_tables.hpp"
#include "shoal/analysis/experiments/sweep/sweep.hpp"
#include "shoal/core/message.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {
namespace {

namespace fs = std::filesystem;
using analysis::SweepProgress;

std::string duration_text(double seconds) {
  const auto whole = std::lround(seconds);
  if (whole < 100) return fmt::format("{} s", whole);
  if (whole < 6000) return fmt::format("{} min", (whole + 30) / 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

/// A line that renews itself on a terminal; elsewhere a line a minute.
class ProgressLine {
 public:
  explicit ProgressLine(bool terminal) : terminal_(terminal) {}

  void show(const SweepProgress& p) {
    const std::size_t to_run = p.planned - p.stored;
    if (!terminal_ && p.elapsed_s < next_s_) return;
    next_s_ += 60.0;
    const double rate = p.elapsed_s > 0.0 ? static_cast<double>(p.done) / p.elapsed_s : 0.0;
    std::string line =
        fmt::format("{} of {} trials, {} failed", p.stored + p.done, p.planned, p.failed);
    if (p.done > 0 && p.done < to_run) {
      line += fmt::format(", {:.3g} a second, {} left", rate,
                          duration_text(static_cast<double>(to_run - p.done) / rate));
    }
    write_message(terminal_ ? "\r" + line + "\033[K" : line + "\n");
  }

  void end() const {
    if (terminal_) write_message("\r\033[K");
  }

 private:
  bool terminal_;
  double next_s_ = 60.0;
};

/// `I/N`.
void read_shard(const std::string& text, analysis::SweepSettings& settings) {
  const auto parts = split(text, '/');
  const auto whole = [&](std::size_t i) -> double {
    const std::optional<double> number =
        parts.size() == 2 ? parsed_number(parts[i]) : std::optional<double>{};
    return number && *number >= 1.0 && *number <= 1e6 && *number == static_cast<int>(*number)
               ? *number
               : 0.0;
  };
  settings.shard = static_cast<int>(whole(0));
  settings.shards = static_cast<int>(whole(1));
  if (settings.shard < 1 || settings.shards < 1 || settings.shard > settings.shards) {
    throw InputError("--shard " + text + " is no part; write I/N, as 2/8 for the second of eight");
  }
}

analysis::TrialList plan_of(const SweepArguments& arguments) {
  Setting root = scenarios::read_toml(study_file(arguments.study));
  if (arguments.replications > 0) analysis::set_replications(root, arguments.replications);
  analysis::TrialList list(analysis::read_study(root));
  analysis::require_answerable(list);
  return list;
}

[[noreturn]] void sweep_by_dask(const SweepArguments& arguments) {
  if (!arguments.shard.empty() || arguments.fail_fast) {
    throw InputError("--dask takes neither --shard nor --fail-fast: workers share all trials");
  }
  if (package_path().empty()) {
    throw SystemError("this shoal was built without its Python package, which --dask needs");
  }
  std::vector<std::string> words{"-m", "shoal.distributed", arguments.study, arguments.dask};
  if (!arguments.out.empty()) words.insert(words.end(), {"--out", arguments.out});
  words.insert(words.end(), {"--batch", std::to_string(arguments.batch)});
  words.insert(words.end(), {"--replications", std::to_string(arguments.replications)});
  if (arguments.rerun_changed) words.emplace_back("--rerun-changed");
  if (arguments.retry_failed) words.emplace_back("--retry-failed");
  become_python("talks with dask", words);
}

}  // namespace

void sweep(const SweepArguments& arguments) {
  if (!arguments.dask.empty()) sweep_by_dask(arguments);
  const analysis::TrialList list = plan_of(arguments);
  const fs::path folder = arguments.out.empty() ? fs::path("out") / fs::path(arguments.study).stem()
                                                : fs::path(arguments.out);
  analysis::SweepSettings settings{.jobs = arguments.jobs,
                                   .fail_fast = arguments.fail_fast,
                                   .rerun_changed = arguments.rerun_changed,
                                   .retry_failed = arguments.retry_failed,
                                   .worker_program = fs::read_symlink("/proc/self/exe").string(),
                                   .progress = {}};
  if (!arguments.shard.empty()) read_shard(arguments.shard, settings);
  ProgressLine line(::isatty(STDERR_FILENO) == 1);
  settings.progress = [&](const SweepProgress& progress) { line.show(progress); };
  const SweepProgress progress = analysis::sweep(list, folder, settings);
  line.end();

  fmt::print("{}: {} of {} trials are stored, {} of them run now in {:.1f} s\n", folder.string(),
             progress.stored + progress.done, progress.planned, progress.done, progress.elapsed_s);
  if (progress.failed > 0) {
    fmt::print("{} failed; the first: {}; --retry-failed runs them again\n", progress.failed,
               progress.first_failure);
  }
  if (settings.shards > 1) return;  // a part of a study has no tables of its own
  tables(folder.string(), true);
  const bool drawn = arguments.figures && figures_drawn(folder.string());
  report(folder.string());
  if (drawn) fmt::print("written: {}, each as .pdf and .svg\n", (folder / "figures").string());
}

}  // namespace shoal::program
