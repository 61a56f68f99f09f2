#include "shoal/analysis/experiments/store/manifest.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/analysis/experiments/plugins.hpp"
#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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
  Json plugins = Json::array();
  for (const Plugin& plugin : loaded_plugins()) {
    plugins.push_back({{"file", plugin.file.string()}, {"hash", plugin.hash}});
  }
  return {{"version", built.version}, {"program", built.program},   {"commit", built.commit},
          {"dirty", built.dirty},     {"compiler", built.compiler}, {"libraries", libraries},
          {"plugins", plugins}};
}

constexpr const char* move_away =
    "; move it away and run shoal sweep again: the trials are in trials.sqlite, and stay there";

/// What is wrong with a list of sweeps or of merges.
std::optional<std::string> complaint(const Json& manifest, const std::string& list) {
  const auto entries = manifest.find(list);
  if (entries == manifest.end()) return std::nullopt;
  if (!entries->is_array()) return list + " is no list";
  for (const Json& entry : *entries) {
    if (!entry.is_object()) return list + " holds an entry that is no object";
    const auto began = entry.find("began");
    if (began == entry.end() || !began->is_string()) {
      return list + " holds an entry without the time at which it began";
    }
  }
  return std::nullopt;
}

Json parsed(const std::string& text, const fs::path& file) {
  if (text.empty()) throw InputError({file.string()}, std::string("the file is empty") + move_away);
  try {
    return Json::parse(text);
  } catch (const Json::exception&) {
    throw InputError({file.string()}, std::string("the file is no valid JSON") + move_away);
  }
}

/// Entries of both, once each, in the order in which they began.
void unite(Json& entries, const Json& others) {
  for (const Json& other : others) {
    if (std::ranges::find(entries, other) == entries.end()) entries.push_back(other);
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Json& a, const Json& b) {
    return a.value("began", "") < b.value("began", "");
  });
}

}  // namespace

Json stored_manifest(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  if (!fs::exists(file)) return nullptr;
  const std::optional<std::string> text = read_whole_file(file);
  if (!text) throw InputError({file.string()}, std::string("the file cannot be read") + move_away);
  Json manifest = parsed(*text, file);
  std::optional<std::string> wrong;
  if (!manifest.is_object() || !manifest.contains("sweeps")) wrong = "it lists no sweeps";
  if (!wrong) wrong = complaint(manifest, "sweeps");
  if (!wrong) wrong = complaint(manifest, "merges");
  if (wrong) throw InputError({file.string()}, *wrong + move_away);
  return manifest;
}

struct Manifest::Content {
  Json sweeps = Json::array(), merges = Json::array();
  std::string began = now_utc();
  Json own;  // the sweep that runs now
};

Manifest::Manifest(const TrialList& list, const fs::path& folder)
    : list_(list), folder_(folder), content_(std::make_unique<Content>()) {
  const Json before = stored_manifest(folder);
  if (before.is_null()) return;
  content_->sweeps = before["sweeps"];
  content_->merges = before.value("merges", Json::array());
}

Manifest::~Manifest() = default;

void Manifest::begin_sweep(const SweepSettings& settings) {
  Json& own = content_->own;
  own = {{"host", host()}, {"program", program()}, {"jobs", settings.jobs}};
  if (settings.shards > 1) {
    own["shard"] = std::to_string(settings.shard) + "/" + std::to_string(settings.shards);
  }
  own["began"] = content_->began;
  write();
}

void Manifest::end_sweep(const SweepProgress& progress) {
  Json& own = content_->own;
  own["ended"] = now_utc();
  own["trials_run"] = progress.done;
  own["failed"] = progress.failed;
  own["wall_s"] = progress.elapsed_s;
  write();
}

void Manifest::take_history(const fs::path& other) {
  const Json theirs = stored_manifest(other);
  if (theirs.is_null()) {
    throw InputError(other.string() +
                     " holds no manifest.json that says what ran its trials; name a folder that "
                     "shoal sweep wrote");
  }
  unite(content_->sweeps, theirs["sweeps"]);
  unite(content_->merges, theirs.value("merges", Json::array()));
}

void Manifest::end_merge(const std::vector<MergedFolder>& folders) {
  Json parts = Json::array();
  for (const MergedFolder& each : folders) {
    parts.push_back({{"folder", fs::absolute(each.folder).lexically_normal().string()},
                     {"trials", each.trials},
                     {"taken", each.taken}});
  }
  content_->merges.push_back({{"host", host()},
                              {"program", program()},
                              {"began", content_->began},
                              {"ended", now_utc()},
                              {"folders", parts}});
  write();
}

void Manifest::write() const {
  const Study& study = list_.study();
  int most = 0;
  Json groups = Json::array();
  for (const TrialGroup& group : list_.groups()) {
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
                       {"hash", hash_of(read_whole_file(folder_ / "study.toml").value())},
                       {"groups", groups},
                       {"trials", list_.trials()}};
  manifest["seeds"] = {{"first", study.seed}, {"last", study.seed + most - 1}};
  manifest["program"] = program();
  manifest["sweeps"] = content_->sweeps;
  if (!content_->own.is_null()) manifest["sweeps"].push_back(content_->own);
  if (!content_->merges.empty()) manifest["merges"] = content_->merges;
  write_whole_file(folder_ / "manifest.json", manifest.dump(2) + "\n");
}

}  // namespace shoal::analysis
