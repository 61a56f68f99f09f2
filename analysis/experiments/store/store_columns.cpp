#include "shoal/analysis/experiments/store/store_columns.hpp"

namespace shoal::analysis {
namespace {

std::string quoted_column(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace

std::string factor_column(const std::string& factor) {
  return quoted_column("f:" + factor);
}

std::string measure_column(const std::string& measure) {
  return quoted_column(measure);
}

}  // namespace shoal::analysis
