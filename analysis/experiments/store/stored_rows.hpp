#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/store/sqlite.hpp"
#include "shoal/analysis/experiments/store/store.hpp"
#include "shoal/analysis/experiments/store/store_columns.hpp"

namespace shoal::analysis {

/// Throws InputError: the store says what no store writes.
[[noreturn]] void refuse_damaged(const std::filesystem::path& store, const std::string& why);

/// The rows of the table `trial`, one after the other, without their series.
class TrialRows {
 public:
  /// Of all trials, or of that with the key. `columns` are those of the store, `measures` those to
  /// be read: null where the store has none of that name.
  TrialRows(sqlite3* connection, std::filesystem::path store, const StoreColumns& columns,
            const std::vector<std::string>& measures, const std::optional<std::string>& key = {});

  /// Whether there is another row, which trial() then reads.
  bool step() { return select_.step(); }
  /// Throws InputError that names the trial and the column if that holds what no store writes.
  StoredTrial trial() const;

 private:
  std::filesystem::path store_;
  std::vector<std::string> factors_, measures_;
  Statement select_;
};

/// The rows of the table `series`, likewise.
class SeriesRows {
 public:
  enum class Of { trial, name };

  /// All series of the trial with the key `which`, by name; or those of the name `which`.
  SeriesRows(sqlite3* connection, std::filesystem::path store, Of of, const std::string& which);

  bool step() { return select_.step(); }
  std::string key() const { return select_.text(0); }  ///< of its trial
  /// Throws InputError that names series, trial and column.
  scenarios::Series series() const;

 private:
  std::filesystem::path store_;
  Statement select_;
};

}  // namespace shoal::analysis
