#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>

#include "commands.hpp"
#include "python.hpp"
#include "shoal/analysis/experiments/named_files.hpp"
#include "shoal/analysis/experiments/sweep/progress_text.hpp"
#include "shoal/analysis/reporting/study_report.hpp"
#include "shoal/core/message.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "show_tables.hpp"

namespace shoal::program {
namespace {

namespace fs = std::filesystem;
using analysis::SweepProgress;

/// A line that renews itself on a terminal; elsewhere a line a minute.
class ProgressLine {
 public:
  explicit ProgressLine(bool terminal) : terminal_(terminal) {}

  void show(const SweepProgress& p) {
    if (!terminal_ && p.elapsed_s < next_s_) return;
    next_s_ += 60.0;
    const std::string line = analysis::progress_text(p);
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
  if (arguments.figures) words.insert(words.end(), {"--figures", figures_package()});
  become_python("talks with dask", words);
}

}  // namespace

void sweep(const SweepArguments& arguments) {
  if (!arguments.dask.empty()) sweep_by_dask(arguments);
  const analysis::PlannedStudy planned = analysis::planned_study(
      scenarios::read_toml(analysis::study_file(arguments.study)), arguments.replications);
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
  const SweepProgress progress = analysis::sweep(planned.list, folder, settings);
  line.end();

  for (const std::string& each : analysis::summary_lines(progress, folder)) {
    fmt::print("{}\n", each);
  }
  if (settings.shards > 1) return;  // a part of a study has no tables of its own
  analysis::SweptStudy study(folder);
  show_tables(study, true);
  const bool drawn = arguments.figures && figures_drawn(folder.string());
  analysis::write_study_report(study);
  fmt::print("written: {}\n", (folder / "report.html").string());
  if (drawn) fmt::print("written: {}, each as .pdf and .svg\n", (folder / "figures").string());
}

}  // namespace shoal::program
