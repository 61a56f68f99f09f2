#include "shoal/analysis/experiments/results/results.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "shoal/analysis/experiments/store/planned_trial.hpp"

namespace shoal::analysis {

std::optional<double> value_at(const scenarios::Series& series, double time_s) {
  const auto& times = series.time_s;
  const auto after = std::ranges::lower_bound(times, time_s);
  if (after == times.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(after - times.begin());
  if (times[k] == time_s) return series.values[k];
  if (k == 0) return std::nullopt;
  const double share = (time_s - times[k - 1]) / (times[k] - times[k - 1]);
  return series.values[k - 1] + share * (series.values[k] - series.values[k - 1]);
}

std::optional<double> time_of(const scenarios::Series& series, double value) {
  const auto& values = series.values;
  const auto reached = std::ranges::find_if(values, [&](double v) { return v >= value; });
  if (reached == values.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(reached - values.begin());
  if (values[k] == value) return series.time_s[k];
  if (k == 0) return std::nullopt;
  const double share = (value - values[k - 1]) / (values[k] - values[k - 1]);
  return series.time_s[k - 1] + share * (series.time_s[k] - series.time_s[k - 1]);
}

StudyResults::StudyResults(const TrialList& list, const std::vector<std::string>& measures,
                           const std::vector<std::string>& series)
    : list_(list), states_(list.trials(), State::missing), failures_(list.trials()) {
  for (const std::string& name : measures) {
    measures_[name].resize(list.trials());
    const auto known = std::ranges::find(known_values(), name, &Quantity::name);
    if (known == known_values().end()) continue;  // stored by another program
    for (const std::string& companion : {known->censored_by, known->event}) {
      if (companion.empty()) continue;
      measures_[companion].resize(list.trials());
      events_[name] = *known;
    }
  }
  for (const std::string& name : series) series_[name].resize(list.trials());
}

StudyResults::StudyResults(const TrialList& list, const Store& store,
                           const std::vector<std::string>& measures,
                           const std::vector<std::string>& series)
    : StudyResults(list, measures, series) {
  std::unordered_map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < list.trials(); ++i) {
    const ListedTrial& trial = list.trial(i);
    place.emplace(list.groups()[trial.group].key(trial.cell, trial.replication), i);
  }
  const auto take = [&](const StoredTrial& stored) {
    const auto found = place.find(stored.key);
    if (found == place.end()) return;  // of an earlier form of the study
    if (const auto wrong = contradiction(list, list.trial(found->second), stored)) {
      throw InputError({store.file().string()}, "the trial " + stored.key + ": " + *wrong +
                                                    "; run shoal sweep with --rerun-changed");
    }
    if (program_.empty()) program_ = stored.program;
    if (stored.program != program_) {
      throw InputError("trials of this study were run by shoal " + program_ + " and by " +
                       stored.program + "; run shoal sweep with --rerun-changed");
    }
    states_[found->second] = stored.failed() ? State::failed : State::done;
    failures_[found->second] = stored.failure;
    for (const auto& [name, value] : stored.measures) measures_.at(name)[found->second] = value;
  };
  std::vector<std::string> wanted;
  for (const auto& [name, values] : measures_) wanted.push_back(name);
  store.visit(take, wanted);
  for (const std::string& name : series) {
    for (auto& [key, numbers] : store.series(name)) {
      const auto found = place.find(key);
      if (found != place.end()) series_[name][found->second] = std::move(numbers);
    }
  }
}

std::size_t StudyResults::count(State state) const {
  return static_cast<std::size_t>(std::ranges::count(states_, state));
}

const scenarios::Series* StudyResults::series(const std::string& name, std::size_t trial) const {
  const auto found = series_.find(name);
  if (found == series_.end()) throw std::logic_error("the series " + name + " was not read");
  const auto& numbers = found->second[trial];
  return numbers ? &*numbers : nullptr;
}

std::optional<double> StudyResults::stored(const std::string& measure, std::size_t trial) const {
  const auto found = measures_.find(measure);
  if (found == measures_.end()) throw std::logic_error("the measure " + measure + " was not read");
  return states_[trial] == State::done ? found->second[trial] : std::nullopt;
}

Answer StudyResults::answer(const Question& question, std::size_t trial) const {
  if (states_[trial] == State::missing) return {Answer::Kind::not_run};
  if (states_[trial] == State::failed) return {Answer::Kind::failed};
  const auto defined = [](const std::optional<double>& number) {
    return number ? Answer{Answer::Kind::value, *number} : Answer{Answer::Kind::undefined};
  };
  if (!question.measure.empty()) {
    const std::optional<double> value = stored(question.measure, trial);
    const auto event = events_.find(question.measure);
    if (event == events_.end()) return defined(value);
    const auto& [name, unit, meaning, censored_by, time] = event->second;
    const std::optional<double> bound = time.empty() ? stored(censored_by, trial) : value;
    const bool reached = time.empty() ? value.has_value() : stored(time, trial).has_value();
    if (reached || !bound) return defined(value);
    return {Answer::Kind::never_reached, *bound};
  }
  const scenarios::Series* numbers = series(question.series, trial);
  if (!numbers) return defined(std::nullopt);
  if (question.against.empty()) return defined(value_at(*numbers, question.at));
  const scenarios::Series* against = series(question.against, trial);
  if (!against) return defined(std::nullopt);
  const std::optional<double> time_s = time_of(*against, question.at);
  return defined(time_s ? value_at(*numbers, *time_s) : std::nullopt);
}

}  // namespace shoal::analysis
