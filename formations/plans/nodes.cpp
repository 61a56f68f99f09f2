#include <map>

#include "shoal/core/text.hpp"
#include "shoal/formations/plan.hpp"

namespace shoal::formations {
namespace {

/// A plan in the thesis' own form, one string per vehicle (Rypkema 2015, Table 3.3).
struct Nodes final : PlanSource {
  std::vector<std::string> nodes;
  Origin origin;

  static void declare(Options<Nodes>& o) {
    o.texts("nodes", &Nodes::nodes, "slots, each as \"name = NODE_1, x = 0, y = 300\" in metres");
  }

  Plan plan() const override {
    std::vector<std::string> names;
    std::vector<Eigen::Vector2d> slots;
    for (const std::string& node : nodes) {
      const auto values = values_of(node);
      names.push_back(values.at("name"));
      slots.emplace_back(number(node, values, "x"), number(node, values, "y"));
    }
    // The plan itself would refuse these too, but without the strings.
    if (const auto pair = same_name(names))
      complain(*pair, "have the same name; rename one of them");
    if (const auto pair = same_place(slots))
      complain(*pair, "are at the same place; move one of them");
    return Plan(std::move(names), std::move(slots), origin).centred();
  }

 private:
  using Values = std::map<std::string, std::string, std::less<>>;

  Values values_of(const std::string& node) const {
    static const std::vector<std::string> known{"name", "x", "y"};
    Values values;
    for (const std::string_view part : split(node, ',')) {
      const auto equals = part.find('=');
      const std::string key(trimmed(part.substr(0, equals)));
      if (equals == std::string_view::npos) {
        complain(node, "\"" + key + "\" is no key = value; write name = NODE_1, x = 0, y = 300");
      }
      if (std::ranges::find(known, key) == known.end()) {
        complain(node, "there is no key \"" + key + '"' + suggestion(key, known));
      }
      const std::string value(trimmed(part.substr(equals + 1)));
      if (value.empty()) complain(node, key + " is empty");
      if (!values.emplace(key, value).second) complain(node, key + " is given twice");
    }
    for (const std::string& key : known) {
      if (!values.contains(key)) complain(node, key + " is missing");
    }
    return values;
  }

  double number(const std::string& node, const Values& values, const std::string& key) const {
    if (const auto number = parsed_number(values.at(key))) return *number;
    complain(node, key + " is \"" + values.at(key) + "\"; it takes a finite number of metres");
  }

  [[noreturn]] void complain(const std::string& node, const std::string& what) const {
    throw InputError(origin, "in the node \"" + node + "\": " + what);
  }

  [[noreturn]] void complain(std::pair<int, int> pair, const std::string& what) const {
    throw InputError(origin, "the nodes \"" + nodes[static_cast<std::size_t>(pair.first)] +
                                 "\" and \"" + nodes[static_cast<std::size_t>(pair.second)] +
                                 "\" " + what);
  }
};

const Register<PlanSource, Nodes> registered{
    "nodes", "slots written out as strings (Rypkema 2015, Table 3.3)"};

}  // namespace
}  // namespace shoal::formations
