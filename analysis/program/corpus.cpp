#include "shoal/analysis/benchmarking/corpus.hpp"

#include <fmt/core.h>

#include "commands.hpp"
#include "shoal/analysis/benchmarking/problem_recorder.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/behaviour_choice.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::program {
namespace {

/// At most `keep` of them, evenly spread over vehicles and time.
void thin(std::vector<analysis::Situation>& situations, std::size_t keep) {
  const std::size_t all = situations.size();
  if (all <= keep) return;
  for (std::size_t k = 0; k < keep; ++k) situations[k] = std::move(situations[k * all / keep]);
  situations.resize(keep);
}

analysis::Corpus recorded(const std::string& name, const std::string& behaviour,
                          const CorpusArguments& arguments) {
  Setting root = scenarios::read_toml(scenarios::find_scenario(name));
  scenarios::choose_behaviour(root, behaviour);
  scenarios::apply_set(root, "trial.duration_s=" + shortest(arguments.duration_s));
  scenarios::apply_set(root, "trial.seed=" + arguments.seed);
  const scenarios::Scenario scenario = scenarios::read_scenario(root);
  analysis::ProblemRecorder recorder;
  const analysis::Trial trial =
      analysis::run_trial(scenario, {.record = false, .plan_observer = recorder.of_trial()});
  analysis::Corpus corpus = recorder.corpus(scenario, name, trial.world->plan());
  thin(corpus.situations, static_cast<std::size_t>(arguments.keep));
  return corpus;
}

}  // namespace

void corpus(const CorpusArguments& arguments) {
  analysis::require_writable_file(arguments.file);
  analysis::Corpus all;
  for (const std::string& scenario : scenarios::library_scenarios()) {
    for (const std::string& behaviour : Registry<formations::Behaviour>::instance().names()) {
      analysis::Corpus corpus = recorded(scenario, behaviour, arguments);
      fmt::print("{:<32} {:<26} {:>6}\n", scenario, behaviour, corpus.situations.size());
      all.append(std::move(corpus));
    }
  }
  analysis::write_corpus(all, arguments.file);
  fmt::print("written: {}, {} situations in which problems were posed\n", arguments.file,
             all.situations.size());
}

}  // namespace shoal::program
