#include "shoal/analysis/experiments/store/stored_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

std::string trials_query(const StoreColumns& columns, const std::vector<std::string>& measures) {
  std::string list = columns_of_every_trial;
  for (const std::string& name : columns.factors) list += ", " + factor_column(name);
  for (const std::string& name : measures) {
    const bool known = std::ranges::find(columns.measures, name) != columns.measures.end();
    list += known ? ", " + measure_column(name) : std::string(", NULL");
  }
  return "SELECT " + list + " FROM trial";
}

std::string series_query(SeriesRows::Of of) {
  const std::string all = "SELECT trial_key, name, unit, meaning, time_s, numbers FROM series";
  return all +
         (of == SeriesRows::Of::trial ? " WHERE trial_key = ? ORDER BY name" : " WHERE name = ?");
}

}  // namespace

void refuse_damaged(const fs::path& store, const std::string& why) {
  throw InputError({store.string()},
                   why + "; the file is damaged, move it away and run the study again");
}

TrialRows::TrialRows(sqlite3* connection, fs::path store, const StoreColumns& columns,
                     const std::vector<std::string>& measures,
                     const std::optional<std::string>& key)
    : store_(std::move(store)),
      factors_(columns.factors),
      measures_(measures),
      select_(connection, trials_query(columns, measures) + (key ? " WHERE trial_key = ?" : "")) {
  if (key) select_.bind(1, *key);
}

StoredTrial TrialRows::trial() const {
  StoredTrial trial;
  trial.key = select_.text(0);
  int place = 1;
  const auto require = [&](bool holds, const std::string& column, const char* what) {
    if (!holds)
      refuse_damaged(store_, "the trial " + trial.key + ": " + column + " holds no " + what);
  };
  const auto text = [&](const char* column) {
    require(select_.holds_text(place), column, "text");
    return select_.text(place++);
  };
  const auto integer = [&](const char* column) {
    require(select_.holds_integer(place), column, "integer");
    return select_.integer(place++);
  };
  trial.id = text("trial_id");
  trial.scenario = text("scenario_id");
  trial.group = text("study_group");
  const std::int64_t replication = integer("replication");
  require(std::in_range<int>(replication) && replication >= 0, "replication",
          "integer of 0 or more");
  trial.replication = static_cast<int>(replication);
  trial.seed = integer("seed");
  trial.program = text("program");
  const std::string status = text("status");
  require(status == "done" || status == "failed", "status", "\"done\" and no \"failed\"");
  if (status == "failed") {
    require(select_.holds_text(place) && !select_.text(place).empty(), "reason", "text");
    trial.failure = select_.text(place);
  }
  ++place;
  require(select_.holds_number(place), "wall_s", "number");
  trial.wall_s = *select_.number(place++);
  for (const std::string& name : factors_) {
    require(select_.null(place) || select_.holds_text(place), "f:" + name, "text");
    if (!select_.null(place)) trial.factors.emplace_back(name, select_.text(place));
    ++place;
  }
  for (const std::string& name : measures_) {
    require(select_.null(place) || select_.holds_number(place), name, "number");
    trial.measures.emplace_back(name, select_.number(place++));
  }
  return trial;
}

SeriesRows::SeriesRows(sqlite3* connection, fs::path store, Of of, const std::string& which)
    : store_(std::move(store)), select_(connection, series_query(of)) {
  select_.bind(1, which);
}

scenarios::Series SeriesRows::series() const {
  const std::string name = select_.text(1);
  const auto refuse = [&](const std::string& why) {
    refuse_damaged(store_, "the series " + name + " of the trial " + key() + " has " + why);
  };
  if (!select_.holds_numbers(4)) refuse("no numbers in time_s");
  if (!select_.holds_numbers(5)) refuse("no numbers in numbers");
  scenarios::Series series{name, select_.text(2), select_.text(3), select_.numbers(4),
                           select_.numbers(5)};
  if (series.time_s.size() != series.values.size()) {
    refuse(fmt::format("{} instants and {} numbers", series.time_s.size(), series.values.size()));
  }
  return series;
}

}  // namespace shoal::analysis
