#include "shoal/core/csv_line.hpp"

#include <algorithm>

#include "shoal/core/text.hpp"

namespace shoal {
namespace {

/// One number, or several with blanks between them.
bool is_of_numbers(const std::string& text) {
  return std::ranges::all_of(split(text, ' '), [](std::string_view word) {
    return word.empty() || word == "-inf" || parsed_number(word);
  });
}

std::string without_formula(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n\"");
  const bool is_formula = first != std::string::npos &&
                          std::string_view("=+-@").find(text[first]) != std::string_view::npos;
  const bool is_cut = text.starts_with('\t') || text.starts_with('\r');
  return (is_formula || is_cut) && !is_of_numbers(text) ? "'" + text : text;
}

std::string quoted_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string inside;
  for (const char c : text) inside += c == '"' ? std::string("\"\"") : std::string(1, c);
  return '"' + inside + '"';
}

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string joined;
  for (const std::string& field : fields)
    joined += (&field == &fields.front() ? "" : ",") + quoted_field(without_formula(field));
  return joined + "\n";
}

}  // namespace shoal
