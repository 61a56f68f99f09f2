#include "shoal/analysis/experiments/evaluation.hpp"

#include <fmt/core.h>

#include <cmath>

#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::unique_ptr<Evaluation> made(const std::string& model) {
  const auto& known = Registry<Evaluation>::instance();
  if (!known.find(model)) {
    const std::vector<std::string> names = known.names();
    throw InputError("shoal eval knows no model \"" + model + '"' + suggestion(model, names));
  }
  return known.make(model, Setting{}, model);
}

CsvColumns columns_of(const Evaluation& model) {
  CsvColumns columns{.pass_over_others = true};
  for (const Evaluation::Column& input : model.inputs()) {
    (input.optional ? columns.optional : columns.required).push_back(input.name);
  }
  return columns;
}

void append_line(std::string& text, std::span<const std::string> fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) text += ',';
    text += fields[i];
  }
  text += '\n';
}

}  // namespace

std::string evaluated(const std::string& model, const std::string& file) {
  const auto evaluation = made(model);
  const CsvTable table({file, {}}, columns_of(*evaluation));

  std::vector<std::string> fields;
  for (const Evaluation::Column& output : evaluation->outputs()) fields.push_back(output.name);
  std::string text;
  append_line(text, fields);
  std::vector<double> numbers;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    numbers.clear();
    evaluation->evaluate(table, row, numbers);
    if (numbers.size() != fields.size()) {
      throw std::logic_error(model + " gives " + std::to_string(numbers.size()) + " numbers for " +
                             std::to_string(fields.size()) + " columns");
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!std::isfinite(numbers[i])) {
        throw InputError(table.origin(row), evaluation->outputs()[i].name + " is " +
                                                shortest(numbers[i]) +
                                                " for this row: its inputs are beyond the model");
      }
      fields[i] = shortest(numbers[i]);
    }
    append_line(text, fields);
  }
  return text;
}

std::string evaluations_text() {
  std::string text = "MODEL is one of";
  const auto& known = Registry<Evaluation>::instance();
  for (const MemberInfo& member : known.members()) {
    const auto model = known.make(member.name, Setting{}, member.name);
    text += fmt::format("\n\n  {}: {}\n    reads\n", member.name, member.summary);
    for (const Evaluation::Column& input : model->inputs()) {
      text += fmt::format("      {:<20} {}{}\n", input.name, input.meaning,
                          input.optional ? " (may be left out)" : "");
    }
    text += "    prints";
    for (const Evaluation::Column& output : model->outputs()) {
      text += fmt::format("\n      {:<20} {}", output.name, output.meaning);
    }
  }
  return text +
         "\n\nThe first line of FILE.csv names its columns, in any order; other columns are "
         "passed\n"
         "over. A row is printed for every row, as CSV; numbers read back as the same bits.";
}

double positive(const CsvTable& table, std::size_t row, const std::string& column) {
  const double number = table.number(row, column);
  if (number > 0.0) return number;
  throw InputError(table.origin(row),
                   column + " is " + shortest(number) + "; it takes a number above 0");
}

}  // namespace shoal::analysis
