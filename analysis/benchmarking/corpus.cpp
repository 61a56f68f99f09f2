#include "shoal/analysis/benchmarking/corpus.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "shoal/core/text_lines.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal::analysis {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Setting& setting) {
  if (const auto* list = std::get_if<Setting::List>(&setting.value)) {
    Json array = Json::array();
    for (const Setting& entry : *list) array.push_back(to_json(entry));
    return array;
  }
  if (setting.is_table()) {
    Json object = Json::object();
    for (const auto& [name, entry] : setting.table()) object[name] = to_json(entry);
    return object;
  }
  if (const auto* text = std::get_if<std::string>(&setting.value)) return *text;
  if (const auto* number = std::get_if<double>(&setting.value)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&setting.value)) return *integer;
  return std::get<bool>(setting.value);
}

Setting to_setting(const Json& json, const Origin& origin) {
  Setting setting;
  setting.origin = origin;
  if (json.is_boolean()) {
    setting.value = json.get<bool>();
  } else if (json.is_number_integer()) {
    setting.value = json.get<std::int64_t>();
  } else if (json.is_number()) {
    setting.value = json.get<double>();
  } else if (json.is_string()) {
    setting.value = json.get<std::string>();
  } else if (json.is_array()) {
    Setting::List list;
    for (const Json& entry : json) list.push_back(to_setting(entry, origin));
    setting.value = std::move(list);
  } else if (json.is_object()) {
    for (const auto& [name, entry] : json.items()) {
      setting.table().emplace_back(name, to_setting(entry, origin));
    }
  } else {
    throw InputError(origin, "an option is null");
  }
  return setting;
}

/// `json` as a list of so many entries, as they are written below.
const Json& entries(const Json& json, std::size_t count, const char* what, const Origin& origin) {
  if (json.is_array() && json.size() == count) return json;
  throw InputError(origin, std::string(what) + " is a list of " + std::to_string(count) +
                               " entries; here it is " +
                               (json.is_array() ? "one of " + std::to_string(json.size())
                                                : std::string(json.type_name())));
}

double number(const Json& json, const char* what, const Origin& origin) {
  if (json.is_number() && std::isfinite(json.get<double>())) return json.get<double>();
  throw InputError(origin, std::string(what) + " has " + json.dump() + " where a number stands");
}

int whole(const Json& json, const char* what, const Origin& origin) {
  const double value = number(json, what, origin);
  if (json.is_number_integer() && std::abs(value) < 1e9) return static_cast<int>(value);
  throw InputError(origin, std::string(what) + " is " + json.dump() + "; it is a whole number");
}

Eigen::Vector2d place(const Json& json, const char* what, const Origin& origin) {
  const Json& both = entries(json, 2, what, origin);
  return {number(both[0], what, origin), number(both[1], what, origin)};
}

Experiment to_experiment(const Json& json, const Origin& origin) {
  std::vector<std::string> names;
  std::vector<Eigen::Vector2d> slots;
  for (const Json& slot : json.at("plan")) {
    const Json& parts = entries(slot, 3, "a slot of the plan", origin);
    names.push_back(parts[0].get<std::string>());
    slots.emplace_back(number(parts[1], "a slot of the plan", origin),
                       number(parts[2], "a slot of the plan", origin));
  }
  std::vector<scenarios::ObstacleOptions> obstacles;
  for (const Json& obstacle : json.at("obstacles")) {
    read(obstacles.emplace_back(), to_setting(obstacle, origin), "obstacle");
  }
  std::optional<Eigen::Vector2d> waypoint;
  if (json.contains("waypoint")) {
    waypoint = place(json["waypoint"], "the waypoint", origin);
  }
  Experiment experiment{
      json.at("scenario").get<std::string>(), to_setting(json.at("behaviour"), origin),
      formations::Plan(std::move(names), std::move(slots), origin), std::move(obstacles), waypoint};
  if (!waypoint && experiment.make_behaviour()->needs_waypoint()) {
    throw InputError(origin, "the behaviour leads to a waypoint, and there is none");
  }
  return experiment;
}

Situation to_situation(const Json& json, const Corpus& corpus, const Origin& origin) {
  Situation situation;
  const int experiment = whole(json.at("experiment"), "experiment", origin);
  if (experiment < 0 || static_cast<std::size_t>(experiment) >= corpus.experiments.size()) {
    throw InputError(origin,
                     "there is no experiment " + std::to_string(experiment) + " above this line");
  }
  situation.experiment = static_cast<std::size_t>(experiment);
  const int slots = corpus.experiments[situation.experiment].plan.size();
  situation.own_slot = whole(json.at("slot"), "slot", origin);
  if (situation.own_slot < 0 || situation.own_slot >= slots) {
    throw InputError(origin, "the plan has no slot " + std::to_string(situation.own_slot));
  }
  const Json& own = entries(json.at("own"), 7, "own", origin);
  const auto of_own = [&](std::size_t i) { return number(own[i], "own", origin); };
  situation.own = {.position = {of_own(0), of_own(1)},
                   .velocity = {of_own(2), of_own(3)},
                   .heading_rad = of_own(4),
                   .speed_m_s = of_own(5),
                   .turn_rate_rad_s = of_own(6)};
  for (const Json& heard : json.at("heard")) {
    constexpr const char* what = "an entry of heard";
    const Json& parts = entries(heard, 7, what, origin);
    const auto part = [&](std::size_t i) { return number(parts[i], what, origin); };
    formations::Neighbour neighbour;
    neighbour.position = {part(0), part(1)};
    neighbour.age_s = part(2);
    neighbour.slot = whole(parts[3], "the slot of an entry of heard", origin);
    neighbour.velocity = {part(4), part(5)};
    neighbour.heading_rad = part(6);
    if (neighbour.slot < formations::anonymous || neighbour.slot >= slots) {
      throw InputError(origin, "the plan has no slot " + std::to_string(neighbour.slot));
    }
    situation.neighbours.push_back(neighbour);
  }
  return situation;
}

}  // namespace

std::unique_ptr<formations::Behaviour> Experiment::make_behaviour() const {
  Choice<formations::Behaviour> choice{""};
  choice.setting().read(Registry<formations::Behaviour>::instance(), behaviour, "behaviour");
  return choice.make();
}

void Corpus::append(Corpus other) {
  const std::size_t before = experiments.size();
  for (Experiment& experiment : other.experiments) experiments.push_back(std::move(experiment));
  for (Situation& situation : other.situations) {
    situation.experiment += before;
    situations.push_back(std::move(situation));
  }
}

void write_corpus(const Corpus& corpus, const std::filesystem::path& file) {
  std::string text;
  for (const Experiment& experiment : corpus.experiments) {
    Json line{{"scenario", experiment.scenario}, {"behaviour", to_json(experiment.behaviour)}};
    Json& plan = line["plan"] = Json::array();
    for (int i = 0; i < experiment.plan.size(); ++i) {
      const Eigen::Vector2d& slot = experiment.plan.slot(i);
      plan.push_back(Json::array({experiment.plan.name(i), slot.x(), slot.y()}));
    }
    Json& obstacles = line["obstacles"] = Json::array();
    for (const scenarios::ObstacleOptions& obstacle : experiment.obstacles) {
      obstacles.push_back(
          to_json(write_options(schema_of<scenarios::ObstacleOptions>(), &obstacle)));
    }
    if (experiment.waypoint) {
      line["waypoint"] = {experiment.waypoint->x(), experiment.waypoint->y()};
    }
    text += line.dump() + "\n";
  }
  for (const Situation& situation : corpus.situations) {
    const formations::OwnState& own = situation.own;
    Json line{{"experiment", situation.experiment},
              {"slot", situation.own_slot},
              {"own",
               {own.position.x(), own.position.y(), own.velocity.x(), own.velocity.y(),
                own.heading_rad, own.speed_m_s, own.turn_rate_rad_s}}};
    Json& heard = line["heard"] = Json::array();
    for (const formations::Neighbour& n : situation.neighbours) {
      heard.push_back(Json::array({n.position.x(), n.position.y(), n.age_s, n.slot, n.velocity.x(),
                                   n.velocity.y(), n.heading_rad}));
    }
    text += line.dump() + "\n";
  }
  write_whole_file(file, text);
}

Corpus read_corpus(const std::filesystem::path& file, std::size_t most_bytes) {
  std::ifstream stream(file);
  if (!stream) throw InputError("cannot open " + file.string());
  Corpus corpus;
  std::string text;
  TextLines lines(stream, file.string(), most_bytes);
  const Origin& origin = lines.origin();
  while (lines.next(text)) {
    try {
      const Json line = Json::parse(text);
      if (line.contains("plan")) {
        corpus.experiments.push_back(to_experiment(line, origin));
      } else {
        corpus.situations.push_back(to_situation(line, corpus, origin));
      }
    } catch (const Json::exception&) {
      throw InputError(origin,
                       "this is no line of a corpus; shoal run --record-problems writes one");
    }
  }
  if (stream.bad()) throw SystemError("cannot read " + file.string());
  if (corpus.situations.empty()) throw InputError(file.string() + ": holds no problem");
  return corpus;
}

}  // namespace shoal::analysis
