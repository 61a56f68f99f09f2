#include "shoal/analysis/solver_comparison.hpp"

#include <algorithm>

#include "shoal/core/text.hpp"
#include "shoal/formations/posed_problems.hpp"

namespace shoal::analysis {
namespace {

/// The solvers of one family that were named.
template <class Member>
struct Entrants {
  ContenderFamily family;
  std::vector<std::unique_ptr<Member>> solvers;

  explicit Entrants(const ComparisonSettings& settings) {
    const Registry<Member>& registry = Registry<Member>::instance();
    family.name = registry.family();
    for (const std::string& name : settings.solvers) {
      if (!registry.find(name)) continue;
      if (name == settings.reference) family.reference = solvers.size();
      const std::string path = family.name + "." + name;
      const Setting* options = settings.options.find_path(path);
      solvers.push_back(registry.make(name, options ? *options : Setting{}, path));
      family.contenders.push_back({name, {}});
    }
  }

  template <class Problem>
  void meet(const Problem& problem, std::size_t turn) {
    if (turn >= solvers.size()) return;
    family.contenders[turn].answers.push_back(answered(*solvers[turn], problem));
  }
};

void require_known(const ComparisonSettings& settings,
                   std::initializer_list<const RegistryBase*> registries) {
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
    if (std::ranges::find(families, family) == families.end()) {
      throw InputError(table.origin, "there is no family of solvers \"" + family + '"' +
                                         suggestion(family, families));
    }
  }
}

}  // namespace

/// Shows each problem to one solver of its family: the one whose turn it is.
class SolverComparison::Arena final : public formations::ProblemViewer {
 public:
  explicit Arena(const ComparisonSettings& settings)
      : smooth(settings), registration(settings), matching(settings) {}

  void see(const solvers::Problem& problem) override { smooth.meet(problem, turn); }
  void see(const solvers::RegistrationProblem& problem) override {
    registration.meet(problem, turn);
  }
  void see(const solvers::MatchingProblem& problem) override { matching.meet(problem, turn); }

  std::size_t turns() const {
    return std::max({smooth.solvers.size(), registration.solvers.size(), matching.solvers.size()});
  }

  std::size_t turn = 0;
  Entrants<solvers::Solver> smooth;
  Entrants<solvers::RegistrationSolver> registration;
  Entrants<solvers::Matcher> matching;
};

SolverComparison::SolverComparison(const ComparisonSettings& settings) {
  require_known(settings, {&Registry<solvers::Solver>::instance(),
                           &Registry<solvers::RegistrationSolver>::instance(),
                           &Registry<solvers::Matcher>::instance()});
  arena_ = std::make_unique<Arena>(settings);
}

SolverComparison::~SolverComparison() = default;

void SolverComparison::run(const Corpus& corpus) {
  std::vector<std::unique_ptr<formations::Behaviour>> behaviours;
  std::vector<std::vector<std::shared_ptr<const formations::Obstacle>>> obstacles;
  for (const Experiment& experiment : corpus.experiments) {
    behaviours.push_back(experiment.make_behaviour());
    obstacles.push_back(scenarios::make_obstacles(experiment.obstacles));
  }
  // One solver after another, not problem by problem: a large one would leave the others a cold
  // cache, and a time that is not theirs.
  for (arena_->turn = 0; arena_->turn < arena_->turns(); ++arena_->turn) {
    for (const Situation& situation : corpus.situations) {
      const formations::Neighbourhood seen{situation.neighbours, situation.own_slot, situation.own,
                                           obstacles[situation.experiment]};
      behaviours[situation.experiment]->pose(seen, corpus.experiments[situation.experiment].plan,
                                             *arena_);
    }
  }
}

std::vector<const ContenderFamily*> SolverComparison::families() const {
  std::vector<const ContenderFamily*> met;
  for (const ContenderFamily* family :
       {&arena_->smooth.family, &arena_->registration.family, &arena_->matching.family}) {
    if (!family->contenders.empty() && !family->contenders.front().answers.empty()) {
      met.push_back(family);
    }
  }
  return met;
}

}  // namespace shoal::analysis
