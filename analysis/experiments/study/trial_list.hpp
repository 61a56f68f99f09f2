#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/study/selection.hpp"
#include "shoal/analysis/experiments/study/study.hpp"

namespace shoal::analysis {

/// The label of a factor in cells where its `only` does not hold.
inline constexpr const char* not_applied = "-";
/// The first column of a group whose design draws its cells: their number, from 1.
inline constexpr const char* sample_column = "sample";

/// The cells of one group. Their order is that of the design.
class TrialGroup {
 public:
  /// Throws InputError if factors, design or exclusions are wrong.
  TrialGroup(const Group& group, std::int64_t replications);

  const std::string& name() const { return group_.name; }
  const Group& group() const { return group_; }
  int replications() const { return static_cast<int>(replications_); }
  /// Whether the design draws cells (and does not combine levels).
  bool sampled() const { return sampled_; }

  /// Names of the columns that tell cells apart: `sample` for a drawn design, then the factors.
  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::string>& units() const { return units_; }
  const std::vector<Axis>& axes() const { return axes_; }

  std::size_t cells() const { return labels_.size(); }
  /// One label a column.
  std::span<const std::string> labels(std::size_t cell) const { return labels_[cell]; }
  /// `behaviour = rigid_registration, period_s = 5`; "" if there is only one cell.
  std::string title(std::size_t cell) const;

  /// What tells one trial of the study from every other: group, labels and replication.
  std::string key(std::size_t cell, int replication) const;

  /// The design as it was drawn: rows x factors.
  const Eigen::MatrixXd& design() const { return design_; }

  /// What a cell changes, axis by axis; nothing where a factor does not apply.
  std::vector<Axis::Place> changes(std::size_t cell) const;

 private:
  std::vector<std::string> labels_of(Eigen::Index row) const;

  Group group_;
  std::int64_t replications_;
  bool sampled_;
  std::vector<Axis> axes_;
  std::vector<CellSelection> only_;
  std::vector<std::string> columns_, units_;
  Eigen::MatrixXd design_;
  std::vector<Eigen::Index> rows_;  // of the design, one a cell
  std::vector<std::vector<std::string>> labels_;
};

/// One trial of a study.
struct ListedTrial {
  std::size_t group, cell;
  int replication;  ///< from 0
};

/// Everything that a study asks for, without its scenarios: the layout of its results.
class TrialList {
 public:
  explicit TrialList(const Study& study);

  const Study& study() const { return study_; }
  const std::vector<TrialGroup>& groups() const { return groups_; }
  std::size_t trials() const { return trials_.size(); }
  const ListedTrial& trial(std::size_t i) const { return trials_[i]; }
  const std::vector<ListedTrial>& all_trials() const { return trials_; }
  /// The place of a trial: cells of a group follow one another, and in each its replications.
  std::size_t index(std::size_t group, std::size_t cell, int replication) const;
  std::int64_t seed(const ListedTrial& trial) const { return study_.seed + trial.replication; }

  /// Places of the trials that belong to the `shard`-th (from 1) of so many parts. The parts are
  /// disjoint, together they are all, and none has two more than another.
  std::vector<std::size_t> part(int shard, int shards) const;

  /// `construction, behaviour = rigid_registration, seed 3`.
  std::string title(const ListedTrial& trial) const;

 private:
  Study study_;
  std::vector<TrialGroup> groups_;
  std::vector<ListedTrial> trials_;
  std::vector<std::size_t> first_trial_;  // of each group
};

}  // namespace shoal::analysis
