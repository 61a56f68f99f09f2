#include "shoal/analysis/study/study_files.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "shoal/analysis/build_info.hpp"
#include "shoal/analysis/study/cell_scenarios.hpp"
#include "shoal/core/option_place.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A study may be read from another folder than the one it was written for.

void make_base_absolute(Setting& name) {
  auto* text = std::get_if<std::string>(&name.value);
  if (!text || text->empty()) return;
  const fs::path file = base_scenario(*text, name.origin);
  const bool ships = file.parent_path() == scenarios::library_path();
  if (!ships) *text = fs::absolute(file).lexically_normal().string();
}

/// Options in a table of changes that name files.
void make_files_absolute(Setting& place, const std::string& key) {
  if (place.is_table()) {
    for (auto& [name, entry] : place.table()) make_files_absolute(entry, dotted(key, name));
    return;
  }
  const OptionPlace named = locate(schema_of<scenarios::Scenario>(), key, place.origin);
  if (named.is_kind || named.member || !named.option->is_file) return;
  place.value = detail::as_file(*named.option, place, key).path.string();
}

void make_set_absolute(Setting& owner) {
  if (Setting* set = owner.find("set")) make_files_absolute(*set, "");
}

Setting::List* list_in(Setting& owner, const char* name) {
  Setting* found = owner.find(name);
  return found ? std::get_if<Setting::List>(&found->value) : nullptr;
}

void make_factor_absolute(Setting& factor) {
  if (Setting::List* levels = list_in(factor, "level")) {
    for (Setting& level : *levels) {
      if (Setting* base = level.find("scenario")) make_base_absolute(*base);
      make_set_absolute(level);
    }
  }
  const Setting* key = factor.find("key");
  const auto* name = key ? std::get_if<std::string>(&key->value) : nullptr;
  Setting::List* values = list_in(factor, "values");
  if (!name || !values) return;
  for (Setting& value : *values) {
    if (*name == "scenario") {
      make_base_absolute(value);
    } else {
      make_files_absolute(value, *name);
    }
  }
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    return std::string(trimmed(line.substr(line.find(':') + 1)));
  }
  return "unknown";
}

Json host() {
  utsname names{};
  ::uname(&names);
  return {{"name", names.nodename},
          {"system", std::string(names.sysname) + " " + names.release},
          {"machine", names.machine},
          {"processor", processor()},
          {"threads", std::thread::hardware_concurrency()}};
}

Json program() {
  const BuildInfo& built = build_info();
  Json libraries = Json::object();
  for (const auto& [name, version] : built.libraries) libraries[name] = version;
  return {{"version", built.version}, {"program", built.program},   {"commit", built.commit},
          {"dirty", built.dirty},     {"compiler", built.compiler}, {"libraries", libraries}};
}

}  // namespace

void write_study(const StudyPlan& plan, const fs::path& folder) {
  Setting written = plan.study().written;
  make_set_absolute(written);
  for (Setting& group : *list_in(written, "group")) {
    if (Setting* base = group.find("scenario")) make_base_absolute(*base);
    make_set_absolute(group);
    Setting::List* factors = list_in(group, "factor");
    if (!factors) continue;
    for (Setting& factor : *factors) make_factor_absolute(factor);
  }
  if (Setting* claims = written.find("claims")) {
    write_whole_file(folder / "claims.toml",
                     text_of(scenarios::resolved(plan.study().claims_file)));
    claims->value = std::string("claims.toml");
  }
  write_whole_file(folder / "study.toml", to_toml(written));
}

StudyPlan stored_plan(const fs::path& folder) {
  const fs::path file = folder / "study.toml";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    throw InputError(folder.string() +
                     " holds no study.toml; name a folder that shoal sweep wrote");
  }
  return StudyPlan(read_study(scenarios::read_toml(file)));
}

Manifest::Manifest(const StudyPlan& plan, const fs::path& folder, const SweepSettings& settings)
    : plan_(plan), folder_(folder), settings_(settings), earlier_("[]"), began_(now_utc()) {
  const Json before = Json::parse(text_of(folder / "manifest.json"), nullptr, false);
  if (before.is_object() && before.contains("sweeps")) earlier_ = before["sweeps"].dump();
}

void Manifest::begin() {
  write("", {});
}

void Manifest::end(const SweepProgress& progress) {
  write(now_utc(), progress);
}

void Manifest::write(const std::string& finished, const SweepProgress& progress) const {
  const Study& study = plan_.study();
  int most = 0;
  Json groups = Json::array();
  for (const PlannedGroup& group : plan_.groups()) {
    most = std::max(most, group.replications());
    groups.push_back({{"name", group.name()},
                      {"scenario", group.group().scenario},
                      {"design", group.group().design.kind()},
                      {"factors", group.columns()},
                      {"cells", group.cells()},
                      {"replications", group.replications()}});
  }
  Json manifest;
  manifest["title"] = study.title;
  manifest["study"] = {{"file", "study.toml"},
                       {"hash", hash_of(text_of(folder_ / "study.toml"))},
                       {"groups", groups},
                       {"trials", plan_.trials()}};
  manifest["seeds"] = {{"first", study.seed}, {"last", study.seed + most - 1}};
  manifest["program"] = program();
  Json sweeps = Json::parse(earlier_);
  Json own{{"host", host()}, {"program", build_info().program}, {"jobs", settings_.jobs}};
  if (settings_.shards > 1) {
    own["shard"] = std::to_string(settings_.shard) + "/" + std::to_string(settings_.shards);
  }
  own["began"] = began_;
  if (!finished.empty()) {
    own["ended"] = finished;
    own["trials_run"] = progress.done;
    own["failed"] = progress.failed;
    own["wall_s"] = progress.elapsed_s;
  }
  sweeps.push_back(own);
  manifest["sweeps"] = sweeps;
  write_whole_file(folder_ / "manifest.json", manifest.dump(2) + "\n");
}

}  // namespace shoal::analysis
