#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "shoal/analysis/experiments/store/merge.hpp"
#include "shoal/analysis/experiments/store/store.hpp"

namespace shoal::analysis {

/// Gathers the trials of a list from stores in one, and refuses those that contradict each other.
class StoredUnion {
 public:
  /// `store` stands in `folder`. Throws InputError if its own trials contradict each other.
  StoredUnion(const TrialList& list, Store& store, const std::filesystem::path& folder);

  MergedFolder own() const { return folders_.front(); }
  /// Writes what the store of another folder has and this one has not. Throws InputError; the
  /// trials written until then stay, so call it in Store::together().
  MergedFolder add(const std::filesystem::path& folder);

  std::size_t stored() const { return known_.size(); }
  std::size_t failed() const { return failed_; }

 private:
  struct Seen {
    std::size_t folder;    // where it was met first
    std::size_t trial;     // its place in the list
    std::string scenario;  // its cell's
  };

  /// Its place in the list; nothing for a trial of an earlier form of the study.
  std::optional<std::size_t> place_of(const StoredTrial& trial) const;
  void require_as_planned(const StoredTrial& trial, const Seen& seen) const;
  void require_one_program(const StoredTrial& trial, const Seen& seen);
  void require_one_scenario(const StoredTrial& trial, const Seen& seen);
  void require_same(const StoredTrial& ours, const StoredTrial& theirs, const Seen& seen,
                    const std::filesystem::path& folder) const;
  void note(const StoredTrial& trial, const Seen& seen);
  std::string title(std::size_t trial) const;

  const TrialList& list_;
  Store& store_;
  std::vector<MergedFolder> folders_;
  std::unordered_map<std::string, std::size_t> places_;
  std::unordered_map<std::string, Seen> known_;    // by key
  std::unordered_map<std::size_t, Seen> of_cell_;  // by the first trial of the cell
  std::optional<Seen> first_;
  std::string program_;
  std::size_t failed_ = 0;
};

/// What two stored trials of one key say differently, but for the time that they took; nothing if
/// they agree. A measure that one of them lacks is null there; a series that one lacks is no
/// difference.
std::optional<std::string> difference(const StoredTrial& a, const StoredTrial& b);

}  // namespace shoal::analysis
