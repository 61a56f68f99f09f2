#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "shoal/analysis/experiments/cf_unit.hpp"
#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/study/group_grid.hpp"
#include "shoal/analysis/reporting/export.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/netcdf_output.hpp"

namespace shoal::analysis {
namespace {

using scenarios::NetcdfOutput;
using Type = NetcdfOutput::Type;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Other letters than these are none for netCDF, or part the names in the attribute coordinates.
std::string netcdf_name(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool kept = byte >= 128 || std::isalnum(byte) != 0 || c == '_' || c == '-' || c == '.';
    text += kept ? c : '_';
  }
  const bool begins_well = !text.empty() && text.front() != '-' && text.front() != '.';
  return begins_well ? text : "_" + text;
}

/// Labels as numbers, NaN where the factor does not apply; nothing if one of them is a text.
std::optional<std::vector<double>> as_numbers(const std::vector<std::string>& labels) {
  std::vector<double> numbers;
  for (const std::string& label : labels) {
    const std::optional<double> number = parsed_number(label);
    if (!number && label != not_applied) return std::nullopt;
    numbers.push_back(number.value_or(nan));
  }
  return numbers;
}

/// Writes one group of a study into a group of a file.
class GroupWriter {
 public:
  GroupWriter(NetcdfOutput& file, NetcdfOutput::Group place, const StudyResults& results,
              std::size_t group)
      : file_(file),
        place_(place),
        results_(results),
        index_(group),
        group_(results.list().groups()[group]),
        grid_(group_),
        replications_(static_cast<std::size_t>(group_.replications())) {}

  void write(const std::vector<std::string>& measures, const std::vector<std::string>& series) {
    file_.text(place_, "design", group_.group().design.kind());
    if (!group_.group().scenario.empty()) file_.text(place_, "scenario", group_.group().scenario);
    for (const GroupGrid::Dimension& d : grid_.dimensions()) {
      dims_.push_back(file_.dimension(place_, netcdf_name(d.name), d.labels.size()));
    }
    group_.sampled() ? write_drawn_factors() : write_levels();
    write_replications();
    write_status();
    for (const std::string& name : measures) write_measure(name);
    write_series(series);
  }

 private:
  void write_coordinate(const std::string& name, NetcdfOutput::Dimension dimension,
                        const std::vector<std::string>& labels, const std::string& unit,
                        const std::string& meaning) {
    const std::string called = netcdf_name(name);
    const std::string long_name = meaning.empty() ? name : meaning;
    if (const auto numbers = as_numbers(labels)) {
      const auto made =
          file_.variable(place_, called, Type::double_float, {dimension}, cf_unit(unit), long_name);
      if (std::ranges::find(labels, not_applied) != labels.end()) {
        file_.text(made, "comment", "NaN: the factor does not apply");
      }
      file_.put(made, *numbers);
    } else {
      file_.put(file_.variable(place_, called, Type::string, {dimension}, "", long_name), labels);
    }
  }

  void write_levels() {
    for (std::size_t f = 0; f < dims_.size(); ++f) {
      write_coordinate(grid_.dimensions()[f].name, dims_[f], grid_.dimensions()[f].labels,
                       group_.units()[f], group_.axes()[f].meaning());
    }
  }

  void write_drawn_factors() {
    write_coordinate("cell", dims_[0], grid_.dimensions()[0].labels, "",
                     "number of the cell in the order of the design, from 1");
    for (std::size_t f = 0; f < group_.axes().size(); ++f) {
      std::vector<std::string> labels;
      for (std::size_t cell = 0; cell < group_.cells(); ++cell) {
        labels.push_back(group_.labels(cell)[f + 1]);  // behind the number of the cell
      }
      const std::string& name = group_.axes()[f].name();
      write_coordinate(name, dims_[0], labels, group_.units()[f + 1], group_.axes()[f].meaning());
      coordinates_ += netcdf_name(name) + " ";
    }
  }

  void write_replications() {
    dims_.push_back(file_.dimension(place_, "replication", replications_));
    std::vector<double> numbers, seeds;
    for (std::size_t k = 0; k < replications_; ++k) {
      numbers.push_back(static_cast<double>(k + 1));
      seeds.push_back(static_cast<double>(results_.list().study().seed) + static_cast<double>(k));
    }
    file_.put(file_.variable(place_, "replication", Type::integer, {dims_.back()}, "",
                             "number of the replication, from 1"),
              numbers);
    file_.put(file_.variable(place_, "seed", Type::double_float, {dims_.back()}, "",
                             "seed of the random numbers, the same in every cell"),
              seeds);
    coordinates_ += "seed";
  }

  NetcdfOutput::Variable variable(const std::string& name, Type type,
                                  const std::vector<NetcdfOutput::Dimension>& dimensions,
                                  const std::string& unit, const std::string& meaning) {
    const auto made = file_.variable(place_, name, type, dimensions, unit, meaning);
    file_.text(made, "coordinates", coordinates_);
    return made;
  }

  std::size_t trial(std::size_t cell, std::size_t k) const {
    return results_.list().index(index_, cell, static_cast<int>(k));
  }

  /// An array over all places of the grid, with `elsewhere` where it has no cell.
  template <class Value>
  std::vector<double> array(double elsewhere, Value value) const {
    std::vector<double> numbers(grid_.size() * replications_, elsewhere);
    for (std::size_t cell = 0; cell < group_.cells(); ++cell) {
      const std::size_t first = grid_.offset(cell) * replications_;
      for (std::size_t k = 0; k < replications_; ++k) numbers[first + k] = value(trial(cell, k));
    }
    return numbers;
  }

  void write_status() {
    const auto made = variable("status", Type::integer, dims_, "", "what became of the trial");
    const std::vector<double> flags{0, 1, 2, 3};
    file_.numbers(made, "flag_values", flags);
    file_.text(made, "flag_meanings", "not_planned missing failed done");
    file_.put(made, array(0.0, [&](std::size_t i) {
                switch (results_.state(i)) {
                  case StudyResults::State::missing:
                    return 1.0;
                  case StudyResults::State::failed:
                    return 2.0;
                  case StudyResults::State::done:
                    return 3.0;
                }
                return nan;
              }));
  }

  void write_measure(const std::string& name) {
    const auto known = std::ranges::find(known_values(), name, &Quantity::name);
    const bool is_known = known != known_values().end();
    const auto made =
        variable(name, Type::double_float, dims_, is_known ? cf_unit(known->unit) : "",
                 is_known ? known->meaning : name);
    file_.fill_with_nan(made);
    file_.compress(made);
    file_.put(made,
              array(nan, [&](std::size_t i) { return results_.stored(name, i).value_or(nan); }));
  }

  template <class Visitor>
  void each_trial(Visitor visit) const {
    for (std::size_t cell = 0; cell < group_.cells(); ++cell) {
      for (std::size_t k = 0; k < replications_; ++k) visit(trial(cell, k));
    }
  }

  /// Trials may have other instants than their neighbours: all of them make the axis.
  std::vector<double> all_instants(const std::vector<std::string>& names) const {
    std::set<double> instants;
    for (const std::string& name : names) {
      each_trial([&](std::size_t i) {
        if (const scenarios::Series* s = results_.series(name, i)) {
          instants.insert(s->time_s.begin(), s->time_s.end());
        }
      });
    }
    return {instants.begin(), instants.end()};
  }

  void write_series(const std::vector<std::string>& names) {
    const std::vector<double> instants = all_instants(names);
    if (instants.empty()) return;  // an axis of no length would be one without end
    std::vector<NetcdfOutput::Dimension> dimensions = dims_;
    dimensions.push_back(file_.dimension(place_, "time", instants.size()));
    file_.put(file_.variable(place_, "time", Type::double_float, {dimensions.back()}, "s",
                             "time since mission start"),
              instants);
    for (const std::string& name : names) write_one_series(name, dimensions, instants);
  }

  void write_one_series(const std::string& name,
                        const std::vector<NetcdfOutput::Dimension>& dimensions,
                        const std::vector<double>& instants) {
    const scenarios::Series* any = nullptr;
    each_trial([&](std::size_t i) { any = any ? any : results_.series(name, i); });
    if (!any) return;
    const auto made = variable(name + "_over_time", Type::double_float, dimensions,
                               cf_unit(any->unit), any->meaning);
    // A cell at a time: the whole may not fit into memory.
    std::vector<std::size_t> count(dimensions.size(), 1);
    count[count.size() - 2] = replications_;
    count.back() = instants.size();
    file_.store_in_blocks(made, count);
    file_.fill_with_nan(made);
    file_.compress(made);
    std::vector<double> block;
    for (std::size_t cell = 0; cell < group_.cells(); ++cell) {
      block.assign(replications_ * instants.size(), nan);
      for (std::size_t k = 0; k < replications_; ++k) {
        const scenarios::Series* s = results_.series(name, trial(cell, k));
        for (std::size_t i = 0; s && i < s->time_s.size(); ++i) {
          const auto at = std::ranges::lower_bound(instants, s->time_s[i]) - instants.begin();
          block[k * instants.size() + static_cast<std::size_t>(at)] = s->values[i];
        }
      }
      std::vector<std::size_t> start = grid_.indices(cell);
      start.insert(start.end(), {0, 0});
      file_.put_block(made, start, count, block);
    }
  }

  NetcdfOutput& file_;
  NetcdfOutput::Group place_;
  const StudyResults& results_;
  std::size_t index_;
  const TrialGroup& group_;
  GroupGrid grid_;
  std::size_t replications_;
  std::vector<NetcdfOutput::Dimension> dims_;  // of measures
  std::string coordinates_;                    // besides those that dimensions have
};

}  // namespace

void StudyExport::write_netcdf(const std::filesystem::path& path) const {
  const TrialList& list = results_.list();
  NetcdfOutput file(path);
  file.text(file.root(), "Conventions", "CF-1.8");
  if (!list.study().title.empty()) file.text(file.root(), "title", list.study().title);
  file.text(file.root(), "source", "shoal " + results_.program());
  for (std::size_t g = 0; g < list.groups().size(); ++g) {
    const std::string& name = list.groups()[g].name();
    const auto place = name.empty() ? file.root() : file.group(file.root(), netcdf_name(name));
    GroupWriter(file, place, results_, g).write(measures_, series_);
  }
  file.finish();
}

}  // namespace shoal::analysis
