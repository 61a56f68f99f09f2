#include "shoal/analysis/experiments/study/factor.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "shoal/core/option_place.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/moved_keys.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::analysis {

void Level::declare(Options<Level>& o) {
  o.text("label", &Level::label, "what the level is called in tables");
  o.text("scenario", &Level::scenario, "another base scenario");
  o.setting("set", &Level::set, "a table of options", "changes to the scenario");
}

std::optional<std::string> Level::complaint() const {
  if (label.empty()) return "a level needs a label";
  if (!set.is_table()) return "set takes a table of options of the scenario";
  return std::nullopt;
}

void Factor::declare(Options<Factor>& o) {
  o.text("name", &Factor::name, "heads its column in tables; default: the last part of its key");
  o.text("key", &Factor::key, "the option that is varied, as for --set");
  o.setting("values", &Factor::values, "a list",
            "the values of the option, in the order of tables");
  o.numbers("range", &Factor::range, "", Range{},
            "[lowest, highest] value; default: the range that the option declares");
  o.integer("steps", &Factor::steps, "", in(2, 1e6), "how many values of the range, evenly spaced");
  o.word("scale", &Factor::scale, {{"linear", Scale::linear}, {"logarithmic", Scale::logarithmic}},
         "spacing of the range");
  o.tables("level", &Factor::levels, "levels that change several options at once");
  o.setting("only", &Factor::only, "a table: factor = label or labels",
            "where the factor applies; elsewhere the scenario's own value holds");
}

std::optional<std::string> Factor::complaint() const {
  const bool has_values = std::holds_alternative<Setting::List>(values.value);
  if (!has_values && !(values.is_table() && values.table().empty())) return "values takes a list";
  if (key.empty() == levels.empty()) {
    return "a factor takes a key with values or a range, or a list of levels ([[factor.level]])";
  }
  if (!levels.empty() && name.empty()) return "a factor with levels needs a name";
  if (!levels.empty() && (has_values || !range.empty() || steps > 0)) {
    return "a factor with levels takes neither values nor a range";
  }
  if (has_values && (!range.empty() || steps > 0)) return "give values or a range, not both";
  if (!range.empty() && (range.size() != 2 || range[0] >= range[1])) {
    return "range takes [lowest, highest], the lower one first";
  }
  if (scale == Scale::logarithmic && !range.empty() && range[0] <= 0.0) {
    return "a logarithmic range must begin above 0";
  }
  if (!only.is_table()) return "only takes a table: factor = label or labels";
  return std::nullopt;
}

std::string label_of(const Setting& value) {
  if (const auto* text = std::get_if<std::string>(&value.value)) return *text;
  if (const auto* number = std::get_if<double>(&value.value)) return shortest(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value.value))
    return std::to_string(*integer);
  if (const auto* flag = std::get_if<bool>(&value.value)) return *flag ? "true" : "false";
  throw InputError(value.origin, "a value of a factor is " + std::string(value.type_name()) +
                                     "; it takes a number, a text, or true or false");
}

Axis::Axis(const Factor& factor)
    : name_(factor.name), key_(factor.key), origin_(factor.origin), scale_(factor.scale) {
  if (name_.empty())
    name_ = key_.substr(key_.rfind('.') == std::string::npos ? 0 : key_.rfind('.') + 1);
  if (!factor.levels.empty()) {
    for (const Level& level : factor.levels)
      places_.push_back({level.label, level.scenario, level.set});
  } else if (key_ == "scenario" || key_ == scenarios::inherits_key) {
    take_values(factor);
  } else {
    scenarios::require_not_moved(key_, factor.origin);
    const OptionPlace place = locate(schema_of<scenarios::Scenario>(), key_, factor.origin);
    if (key_ == "trial.seed") {
      throw InputError(factor.origin,
                       "trial.seed is no factor: replications give every cell the same seeds; set "
                       "replications, and seed for the first of them");
    }
    if (place.member || (place.option->choice && !place.is_kind) || place.option->table ||
        place.option->entry) {
      throw InputError(
          factor.origin,
          key_ + " is a table of options; name one of them" +
              (place.option->choice && !place.option->of_all ? ", or " + key_ + ".kind" : ""));
    }
    if (!place.is_kind) unit_ = place.option->unit;
    meaning_ = place.option->meaning;
    if (std::holds_alternative<Setting::List>(factor.values.value)) {
      take_values(factor);
    } else if (place.is_kind) {
      throw InputError(factor.origin, key_ + " needs values: the names to compare");
    } else {
      take_range(factor, *place.option);
    }
  }
  std::set<std::string> labels;
  for (const Place& place : places_) {
    if (labels.insert(place.label).second) continue;
    throw InputError(factor.origin,
                     "the factor " + name_ + " has two levels \"" + place.label + '"');
  }
}

void Axis::take_values(const Factor& factor) {
  const auto* values = std::get_if<Setting::List>(&factor.values.value);
  if (!values || values->empty()) {
    throw InputError(factor.origin, "the factor " + name_ + " needs values: a list");
  }
  for (const Setting& value : *values) places_.push_back(place_of(value));
}

void Axis::take_range(const Factor& factor, const Option& option) {
  integer_ = option.type == "an integer";
  if (!integer_ && option.type != "a number") {
    throw InputError(factor.origin,
                     key_ + " is " + option.type + "; a range takes numbers, so give values");
  }
  low_ = factor.range.empty() ? option.range.low : factor.range[0];
  high_ = factor.range.empty() ? option.range.high : factor.range[1];
  if (!std::isfinite(low_) || !std::isfinite(high_)) {
    throw InputError(factor.origin, key_ + " takes " + option.range_text() +
                                        ", which is no finite range; give values or a range");
  }
  if (scale_ == Factor::Scale::logarithmic && low_ <= 0.0) {
    throw InputError(factor.origin, "a logarithmic range must begin above 0; give a range");
  }
  for (const double end : {low_, high_}) {
    if (!option.range.contains(end) || (integer_ && end != std::round(end))) {
      throw InputError(factor.origin, "the range of the factor " + name_ + " reaches to " +
                                          shortest(end) + "; " + key_ + " takes " + option.type +
                                          " " + option.range_text());
    }
  }
  for (std::int64_t i = 0; i < factor.steps; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(factor.steps - 1);
    Setting value;
    value.origin = factor.origin;
    if (integer_) {
      value.value = static_cast<std::int64_t>(std::lround(low_ + u * (high_ - low_)));
    } else {
      value.value = value_at(u);
    }
    places_.push_back(place_of(std::move(value)));
  }
}

double Axis::value_at(double u) const {
  if (scale_ == Factor::Scale::linear) return low_ + u * (high_ - low_);
  if (u == 1.0) return high_;
  return low_ * std::pow(high_ / low_, u);
}

Axis::Place Axis::place_of(Setting value) const {
  Place place{label_of(value), "", {}};
  place.set.origin = value.origin;
  if (key_ == "scenario") {
    place.scenario = place.label;
  } else {
    assign(place.set, key_, std::move(value));
  }
  return place;
}

Axis::Place Axis::at(double u) const {
  if (!places_.empty()) {
    const auto last = places_.size() - 1;
    return places_[std::min(static_cast<std::size_t>(u * static_cast<double>(places_.size())),
                            last)];
  }
  Setting value;
  value.origin = origin_;
  if (integer_) {
    value.value =
        static_cast<std::int64_t>(std::min(std::floor(low_ + u * (high_ - low_ + 1.0)), high_));
  } else {
    value.value = value_at(u);
  }
  return place_of(std::move(value));
}

}  // namespace shoal::analysis
