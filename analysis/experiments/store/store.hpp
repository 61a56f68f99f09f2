#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shoal/scenarios/series.hpp"

namespace shoal::analysis {

/// What became of one trial.
struct StoredTrial {
  std::string key;  ///< TrialGroup::key(): group, labels and replication
  std::string group;
  std::vector<std::pair<std::string, std::string>> factors;  ///< name, label
  int replication = 0;                                       ///< from 0
  std::int64_t seed = 0;
  std::string scenario;  ///< CellScenario::identity: the same for all trials of a cell
  std::string id;        ///< trial_identity()
  std::string program;   ///< that ran it
  std::string failure;   ///< why it failed; "" if it did not
  double wall_s = 0.0;
  std::vector<std::pair<std::string, std::optional<double>>> measures;
  std::vector<scenarios::Series> series;

  bool failed() const { return !failure.empty(); }
};

/// The finished trials of a study, in one SQLite file.
///
/// Table `trial` has a row for each, with a column for each factor and each measure; table `series`
/// has their numbers against time. A trial is written in one transaction: a program that is killed
/// loses those that were not finished, and no other.
class Store {
 public:
  enum class Access { write, read };

  /// Opens `folder`/trials.sqlite, made if need be and if writing. Throws SystemError, or
  /// InputError if there is none to read, or if it is no store, or lacks a table.
  Store(const std::filesystem::path& folder, Access access);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  const std::filesystem::path& file() const;

  /// In one transaction. A trial of the same key is replaced. Throws SystemError; then nothing of
  /// the trial is stored. A measure that is NaN is a mistake of the caller: SQLite keeps none.
  void write(const StoredTrial& trial);

  /// In one transaction.
  void erase(const std::vector<std::string>& keys);

  /// What is written and erased in `work` is stored together when it ends, or not at all if it
  /// throws.
  void together(const std::function<void()>& work);

  /// Calls `visitor` with every trial, without its series; in no particular order. With `measures`,
  /// these only (null where no trial of the store has it), else all. What reads trials or series
  /// throws InputError that names the trial and the column if that holds what no store writes, such
  /// as words for a number.
  void visit(const std::function<void(StoredTrial& trial)>& visitor,
             const std::optional<std::vector<std::string>>& measures = {}) const;
  std::vector<StoredTrial> trials(
      const std::optional<std::vector<std::string>>& measures = {}) const;

  /// The trial of that key, with all its measures and without its series.
  std::optional<StoredTrial> find(const std::string& key) const;

  /// All series of one trial, by name.
  std::vector<scenarios::Series> series_of(const std::string& key) const;

  /// The numbers of one series, of every trial that has it, with the key of the trial.
  std::vector<std::pair<std::string, scenarios::Series>> series(const std::string& name) const;

  /// Keys of the trials that have a series of that name.
  std::vector<std::string> keys_with_series(const std::string& name) const;

  /// Names of all measures and of all series that some trial has.
  std::vector<std::string> measure_names() const;
  std::vector<std::string> series_names() const;

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

}  // namespace shoal::analysis
