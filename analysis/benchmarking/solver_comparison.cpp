#include "shoal/analysis/benchmarking/solver_comparison.hpp"

#include <algorithm>

#include "shoal/analysis/benchmarking/problem_family.hpp"
#include "shoal/core/text.hpp"
#include "shoal/formations/solving.hpp"

namespace shoal::analysis {
namespace {

/// Keeps the problems of a corpus, each in its family.
class Sorter final : public solvers::SolveObserver {
 public:
  explicit Sorter(std::vector<ProblemFamily*> families) : families_(std::move(families)) {}

  void solved(const solvers::Solved& what) override {
    for (ProblemFamily* family : families_) family->keep(what);
  }

 private:
  std::vector<ProblemFamily*> families_;
};

/// Refuses options of members that there are not, or that were not named.
void require_of_named(const RegistryBase& registry, const Setting& table,
                      const std::vector<std::string>& named) {
  const std::string& family = registry.family();
  if (table.is_table() && table.find("kind")) {
    throw InputError(table.origin, family +
                                       ".kind: the solvers that are compared are named by "
                                       "--solvers; give options, as " +
                                       family + "." + registry.names().front() + ".OPTION=VALUE");
  }
  ChoiceSetting given;
  given.read(registry, table, family);
  for (const MemberInfo& member : registry.members()) {
    const Setting* options = given.tables.find(member.name);
    if (!options || options->table().empty()) continue;
    if (std::ranges::find(named, member.name) == named.end()) {
      throw InputError(options->origin, family + "." + member.name + ": " + member.name +
                                            " is not among the solvers; name it, or leave its "
                                            "options out");
    }
  }
}

void require_known(const ComparisonSettings& settings,
                   const std::vector<const RegistryBase*>& registries) {
  std::vector<std::string> names, families;
  for (const RegistryBase* registry : registries) {
    families.push_back(registry->family());
    for (const std::string& name : registry->names()) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  std::ranges::sort(names);
  for (const std::string& name : settings.solvers) {
    if (std::ranges::find(names, name) == names.end()) {
      throw InputError("there is no solver \"" + name + '"' + suggestion(name, names));
    }
  }
  const std::string& reference = settings.reference;
  if (!reference.empty() &&
      std::ranges::find(settings.solvers, reference) == settings.solvers.end()) {
    throw InputError("the reference \"" + reference + "\" is not among the solvers" +
                     suggestion(reference, settings.solvers));
  }
  for (const auto& [family, table] : settings.options.table()) {
    const auto found = std::ranges::find(registries, family, &RegistryBase::family);
    if (found == registries.end()) {
      throw InputError(table.origin, "there is no family of solvers \"" + family + '"' +
                                         suggestion(family, families));
    }
    require_of_named(**found, table, settings.solvers);
  }
}

}  // namespace

struct SolverComparison::Entrants {
  Entrants(std::unique_ptr<ProblemFamily> of, const ComparisonSettings& settings)
      : problems(std::move(of)) {
    const RegistryBase& registry = problems->solvers();
    family.name = registry.family();
    for (const std::string& name : settings.solvers) {
      if (!registry.find(name)) continue;
      if (name == settings.reference) family.reference = family.contenders.size();
      const std::string path = family.name + "." + name;
      const Setting* options = settings.options.find_path(path);
      problems->add_solver(name, options ? *options : Setting{}, path);
      family.contenders.push_back({name, {}});
    }
  }

  std::unique_ptr<ProblemFamily> problems;
  ContenderFamily family;
};

SolverComparison::SolverComparison(const ComparisonSettings& settings)
    : progress_(settings.progress) {
  const Registry<ProblemFamily>& kinds = Registry<ProblemFamily>::instance();
  std::vector<std::unique_ptr<ProblemFamily>> families;
  std::vector<const RegistryBase*> registries;
  for (const std::string& name : kinds.names()) {
    families.push_back(kinds.make(name, {}, name));
    registries.push_back(&families.back()->solvers());
  }
  require_known(settings, registries);
  for (auto& family : families) entrants_.emplace_back(std::move(family), settings);
}

SolverComparison::~SolverComparison() = default;

void SolverComparison::run(const Corpus& corpus) {
  std::vector<std::unique_ptr<formations::Behaviour>> behaviours;
  std::vector<std::vector<std::shared_ptr<const formations::Obstacle>>> obstacles;
  for (const Experiment& experiment : corpus.experiments) {
    behaviours.push_back(experiment.make_behaviour());
    obstacles.push_back(scenarios::make_obstacles(experiment.obstacles));
  }
  std::vector<ProblemFamily*> families;
  for (const Entrants& each : entrants_) families.push_back(each.problems.get());
  Sorter sorter(families);
  solvers::SolveObserver* const observers[] = {&sorter};
  const formations::Solving solving(nullptr, observers);
  for (const Situation& situation : corpus.situations) {
    const Experiment& experiment = corpus.experiments[situation.experiment];
    behaviours[situation.experiment]->step(
        {.neighbours = situation.neighbours,
         .own_slot = situation.own_slot,
         .own = situation.own,
         .obstacles = obstacles[situation.experiment],
         .waypoint = experiment.waypoint.value_or(Eigen::Vector2d::Zero())},
        experiment.plan, solving);
  }
  for (Entrants& each : entrants_) {
    std::vector<std::vector<SolverAnswer>> answers = each.problems->answers(progress_);
    for (std::size_t k = 0; k < answers.size(); ++k) {
      each.family.contenders[k].answers = std::move(answers[k]);
    }
  }
}

std::vector<const ContenderFamily*> SolverComparison::families() const {
  std::vector<const ContenderFamily*> met;
  for (const Entrants& each : entrants_) {
    const std::vector<Contender>& contenders = each.family.contenders;
    if (!contenders.empty() && !contenders.front().answers.empty()) met.push_back(&each.family);
  }
  return met;
}

}  // namespace shoal::analysis
