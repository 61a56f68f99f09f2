#include "shoal/analysis/experiments/sweep/progress_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace shoal::analysis {
namespace {

std::string duration_text(double seconds) {
  const auto whole = std::lround(seconds);
  if (whole < 100) return fmt::format("{} s", whole);
  if (whole < 6000) return fmt::format("{} min", (whole + 30) / 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

std::string progress_text(const SweepProgress& p) {
  std::string text =
      fmt::format("{} of {} trials, {} failed", p.stored + p.done, p.planned, p.failed);
  const std::size_t to_run = p.planned - p.stored;
  if (p.done == 0 || p.done >= to_run) return text;
  const double rate = p.elapsed_s > 0.0 ? static_cast<double>(p.done) / p.elapsed_s : 0.0;
  return text + fmt::format(", {:.3g} a second, {} left", rate,
                            duration_text(static_cast<double>(to_run - p.done) / rate));
}

std::vector<std::string> summary_lines(const SweepProgress& p,
                                       const std::filesystem::path& folder) {
  std::vector<std::string> lines{
      fmt::format("{}: {} of {} trials are stored, {} of them run now in {:.1f} s", folder.string(),
                  p.stored + p.done, p.planned, p.done, p.elapsed_s)};
  if (p.failed > 0) {
    lines.push_back(fmt::format("{} failed; the first: {}; --retry-failed runs them again",
                                p.failed, p.first_failure));
  }
  return lines;
}

}  // namespace shoal::analysis
