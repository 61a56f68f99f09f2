#pragma once

#include <span>
#include <string>
#include <vector>

#include "shoal/core/csv_table.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis {

/// A model as a table: a row of outputs for every row of inputs, each row by itself. It lets
/// users compare a model of ours with another implementation of it (`shoal eval`).
///
///     struct Squares final : Evaluation {
///       std::vector<Column> inputs() const override { return {{"x_m", "m, a length"}}; } ...
///     };
///     const Register<Evaluation, Squares> registered{"squares", "squares of lengths"};
class Evaluation {
 public:
  static constexpr const char* family = "evaluation";
  static constexpr const char* family_meaning = "model for shoal eval: outputs for given inputs";

  /// A column of the file that is read, or of the one that is printed.
  struct Column {
    std::string name;
    std::string meaning;  ///< with its unit
    bool optional = false;
  };

  virtual ~Evaluation() = default;
  virtual std::vector<Column> inputs() const = 0;
  virtual std::vector<Column> outputs() const = 0;

  /// Appends one number for every output. Throws InputError, with the origin of the row, for inputs
  /// that the model cannot take.
  virtual void evaluate(const CsvTable& table, std::size_t row, std::vector<double>& out) const = 0;
};

/// The outputs of a model for every row of a CSV file, as CSV with a header. Columns of the file
/// are found by their names; others are passed over. Numbers read back as the same bits.
///
/// Throws InputError for an unknown model, and for what is wrong with the file, before anything is
/// returned.
std::string evaluated(const std::string& model, const std::string& file);

/// What each model reads and prints, for the help of the program.
std::string evaluations_text();

/// A number above zero of a row; else throws InputError that names the line.
double positive(const CsvTable& table, std::size_t row, const std::string& column);

}  // namespace shoal::analysis
