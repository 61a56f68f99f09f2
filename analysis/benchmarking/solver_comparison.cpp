#include "shoal/analysis/benchmarking/solver_comparison.hpp"

#include <algorithm>
#include <chrono>

#include "shoal/core/text.hpp"
#include "shoal/formations/solving.hpp"

namespace shoal::analysis {
namespace {

Eigen::VectorXd stacked(std::size_t count, auto point) {
  Eigen::VectorXd all(2 * static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    all.segment<2>(2 * static_cast<Eigen::Index>(i)) = point(i);
  }
  return all;
}

Eigen::VectorXd place_of(const solvers::Problem&, const solvers::Solution& solution) {
  return solution.x;
}

Eigen::VectorXd place_of(const solvers::RegistrationProblem& problem,
                         const solvers::RegistrationSolution& solution) {
  return stacked(problem.pairs.size(), [&](std::size_t i) -> Eigen::Vector2d {
    return solution.T_to_from * problem.pairs[i].from;
  });
}

Eigen::VectorXd place_of(const solvers::MatchingProblem& problem,
                         const solvers::MatchingSolution& solution) {
  return stacked(solution.slot_of_point.size(), [&](std::size_t i) {
    return problem.slots[static_cast<std::size_t>(solution.slot_of_point[i])];
  });
}

template <class Solver, class Problem>
std::vector<solvers::Trace::Point> traced(const Solver& solver, Problem problem) {
  solvers::Trace trace;
  if constexpr (requires { problem.trace; }) {
    problem.trace = &trace;
    trace.begin();
    solver.solve(problem);
  }
  return trace.points();
}

template <class Solver, class Problem>
SolverAnswer answered(const Solver& solver, const Problem& problem) {
  SolverAnswer answer;
  if (auto why = solver.refuses(problem)) {
    answer.refusal = std::move(*why);
    return answer;
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto solution = solver.solve(problem);
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  static_cast<solvers::Answer&>(answer) = solution;
  answer.place = place_of(problem, solution);
  return answer;
}

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

  /// One solver after another, not problem by problem: a large one would leave the others a cold
  /// cache, and a time that is not theirs.
  template <class Problem>
  void meet(const auto& problems, bool progress) {
    for (std::size_t k = 0; k < solvers.size(); ++k) {
      std::vector<SolverAnswer>& answers = family.contenders[k].answers;
      for (const auto& each : problems) {
        const Problem& problem = each;
        answers.push_back(answered(*solvers[k], problem));
      }
      if (!progress) continue;
      for (std::size_t i = 0; i < problems.size(); ++i) {
        const Problem& problem = problems[i];
        if (answers[i].refusal.empty()) answers[i].progress = traced(*solvers[k], problem);
      }
    }
  }
};

/// The problems of a corpus, as long as its behaviours live.
class Gathered final : public solvers::SolveObserver {
 public:
  struct Registration {
    std::vector<solvers::PointPair> pairs;
    const solvers::Loss* loss;
    operator solvers::RegistrationProblem() const { return {pairs, loss}; }  // NOLINT: is one
  };
  struct Matching {
    std::vector<Eigen::Vector2d> points, slots;
    double ownship_weight;
    operator solvers::MatchingProblem() const { return {points, slots, ownship_weight}; }  // NOLINT
  };

  void solved(const solvers::Problem& problem, const solvers::Solution&) override {
    smooth.push_back(problem);
  }
  void solved(const solvers::RegistrationProblem& problem,
              const solvers::RegistrationSolution&) override {
    registration.push_back({{problem.pairs.begin(), problem.pairs.end()}, problem.loss});
  }
  void solved(const solvers::MatchingProblem& problem, const solvers::MatchingSolution&) override {
    matching.push_back({{problem.points.begin(), problem.points.end()},
                        {problem.slots.begin(), problem.slots.end()},
                        problem.ownship_weight});
  }

  std::vector<solvers::Problem> smooth;
  std::vector<Registration> registration;
  std::vector<Matching> matching;
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
    const auto found = std::ranges::find(registries, family, &RegistryBase::family);
    if (found == registries.end()) {
      throw InputError(table.origin, "there is no family of solvers \"" + family + '"' +
                                         suggestion(family, families));
    }
    require_of_named(**found, table, settings.solvers);
  }
}

}  // namespace

struct SolverComparison::Entries {
  explicit Entries(const ComparisonSettings& settings)
      : smooth(settings), registration(settings), matching(settings), progress(settings.progress) {}

  Entrants<solvers::Solver> smooth;
  Entrants<solvers::RegistrationSolver> registration;
  Entrants<solvers::Matcher> matching;
  bool progress;
};

SolverComparison::SolverComparison(const ComparisonSettings& settings) {
  require_known(settings, {&Registry<solvers::Solver>::instance(),
                           &Registry<solvers::RegistrationSolver>::instance(),
                           &Registry<solvers::Matcher>::instance()});
  entries_ = std::make_unique<Entries>(settings);
}

SolverComparison::~SolverComparison() = default;

void SolverComparison::run(const Corpus& corpus) {
  std::vector<std::unique_ptr<formations::Behaviour>> behaviours;
  std::vector<std::vector<std::shared_ptr<const formations::Obstacle>>> obstacles;
  for (const Experiment& experiment : corpus.experiments) {
    behaviours.push_back(experiment.make_behaviour());
    obstacles.push_back(scenarios::make_obstacles(experiment.obstacles));
  }
  Gathered problems;
  solvers::SolveObserver* const observers[] = {&problems};
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
  entries_->smooth.meet<solvers::Problem>(problems.smooth, entries_->progress);
  entries_->registration.meet<solvers::RegistrationProblem>(problems.registration,
                                                            entries_->progress);
  entries_->matching.meet<solvers::MatchingProblem>(problems.matching, entries_->progress);
}

std::vector<const ContenderFamily*> SolverComparison::families() const {
  std::vector<const ContenderFamily*> met;
  for (const ContenderFamily* family :
       {&entries_->smooth.family, &entries_->registration.family, &entries_->matching.family}) {
    if (!family->contenders.empty() && !family->contenders.front().answers.empty()) {
      met.push_back(family);
    }
  }
  return met;
}

}  // namespace shoal::analysis
