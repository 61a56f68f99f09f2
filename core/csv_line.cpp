#include "shoal/core/csv_line.hpp"

namespace shoal {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string inside;
  for (const char c : text) inside += c == '"' ? std::string("\"\"") : std::string(1, c);
  return '"' + inside + '"';
}

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string joined;
  for (const std::string& field : fields)
    joined += (&field == &fields.front() ? "" : ",") + quoted(field);
  return joined + "\n";
}

}  // namespace shoal
