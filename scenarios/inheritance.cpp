#include "shoal/scenarios/inheritance.hpp"

#include <algorithm>
#include <fstream>

#include "shoal/core/options.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::scenarios {
namespace {

namespace fs = std::filesystem;

fs::path shipped_file(const std::string& name, const Origin& origin) {
  std::vector<std::string> known = library_sets();
  if (std::ranges::find(known, name) != known.end()) return set_file(name);
  const std::vector<std::string> scenarios = library_scenarios();
  if (std::ranges::find(scenarios, name) != scenarios.end()) {
    return library_path() / (name + ".toml");
  }
  known.insert(known.end(), scenarios.begin(), scenarios.end());
  throw InputError(origin, "there is no set or scenario \"" + name +
                               "\" to inherit (a file is named with its .toml)" +
                               suggestion(name, known));
}

fs::path file_of(const Setting& named) {
  const auto& text = std::get<std::string>(named.value);
  if (!names_a_file(text)) return shipped_file(text, named.origin);
  return resolved(shoal::detail::as_file({.type = "a file"}, named, inherits_key));
}

/// Puts `value` beneath: of two tables, the names that `place` lacks, at any depth.
void underlay(Setting& place, const Setting& value) {
  for (const auto& [name, entry] : value.table()) {
    Setting* known = place.find(name);
    if (!known) {
      place.table().emplace_back(name, entry);
    } else if (known->is_table() && entry.is_table()) {
      underlay(*known, entry);
    }
  }
}

class Resolver {
 public:
  explicit Resolver(TomlFiles& files) : files_(files) {}

  /// `below`: the files on the way from the first one to this.
  Setting filled(Setting root, const std::vector<fs::path>& below) {
    std::vector<Setting> named = take_names(root);
    std::ranges::reverse(named);  // what is nearer to the file comes first, and holds
    for (const Setting& each : named) {
      const fs::path file = fs::weakly_canonical(file_of(each));
      if (std::ranges::find(below, file) != below.end()) {
        throw InputError(each.origin, file.string() +
                                          " would inherit from itself on this way; take one " +
                                          inherits_key + " out of the circle");
      }
      if (below.size() >= deepest_inheritance) {
        throw InputError(each.origin, "more than " + std::to_string(deepest_inheritance) +
                                          " files inherit one another in a row; let one of them "
                                          "name a file that is nearer to the end");
      }
      if (++reached_ > most_inherited) {
        throw InputError(each.origin, "more than " + std::to_string(most_inherited) +
                                          " files are inherited in all (one that is inherited in "
                                          "several ways counts each time); let a file that several "
                                          "share be inherited once");
      }
      if (std::ranges::find(seen_, file) == seen_.end()) seen_.push_back(file);
      std::vector<fs::path> with_this = below;
      with_this.push_back(file);
      underlay(root, filled(files_.at(file), with_this));
    }
    return root;
  }

  const std::vector<fs::path>& seen() const { return seen_; }

 private:
  static std::vector<Setting> take_names(Setting& root) {
    const Setting* inherits = root.find(inherits_key);
    if (!inherits) return {};
    std::vector<Setting> names = inherited_names(*inherits);
    std::erase_if(root.table(), [](const auto& entry) { return entry.first == inherits_key; });
    return names;
  }

  TomlFiles& files_;
  std::vector<fs::path> seen_;
  std::size_t reached_ = 0;
};

}  // namespace

const Setting& TomlFiles::at(const fs::path& file) {
  const auto known = read_.find(file.string());
  if (known != read_.end()) return known->second;
  return read_.emplace(file.string(), read_toml(file)).first->second;
}

Inheritance with_inherited(Setting root, TomlFiles& files) {
  std::vector<fs::path> below;
  if (root.origin.line == 0 && names_a_file(root.origin.file)) {
    below.push_back(fs::weakly_canonical(root.origin.file));
  }
  Resolver resolver(files);
  Setting settings = resolver.filled(std::move(root), below);
  return {std::move(settings), resolver.seen()};
}

bool names_a_file(const std::string& inherited) {
  return inherited.find('/') != std::string::npos || inherited.ends_with(".toml");
}

std::string set_summary(const std::string& name) {
  std::string line;
  std::ifstream in(set_file(name));
  std::getline(in, line);
  return line.starts_with('#') ? std::string(trimmed(line.substr(1))) : "";
}

void require_no_scenario_left_out(const Setting& settings, const Setting& changes) {
  const Setting* before = settings.find(inherits_key);
  const Setting* after = changes.find(inherits_key);
  if (!before || !after) return;
  const std::vector<std::string> scenarios = library_scenarios();
  std::vector<std::string> kept;
  for (const Setting& name : inherited_names(*after))
    kept.push_back(std::get<std::string>(name.value));
  for (const Setting& name : inherited_names(*before)) {
    const auto& text = std::get<std::string>(name.value);
    if (std::ranges::find(scenarios, text) == scenarios.end()) continue;
    if (std::ranges::find(kept, text) != kept.end()) continue;
    throw InputError(after->origin, std::string(inherits_key) + " would leave out " + text +
                                        ", from which the scenario takes what it does not say; "
                                        "write it into the list, as " +
                                        inherits_key + " = [\"" + text + "\", \"" +
                                        (kept.empty() ? "SET" : kept.back()) + "\"]");
  }
}

std::vector<Setting> inherited_names(const Setting& inherits) {
  std::vector<Setting> names;
  if (const auto* list = std::get_if<Setting::List>(&inherits.value)) {
    names = *list;
  } else {
    names.push_back(inherits);
  }
  for (const Setting& name : names) {
    if (std::holds_alternative<std::string>(name.value)) continue;
    throw InputError(name.origin, std::string(inherits_key) + " has " +
                                      std::string(name.type_name()) +
                                      "; it takes the name of a set or scenario, a file, or a list "
                                      "of these");
  }
  return names;
}

}  // namespace shoal::scenarios
