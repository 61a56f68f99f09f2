#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shoal/core/setting.hpp"
#include "shoal/formations/behaviour.hpp"
#include "shoal/scenarios/obstacles.hpp"

namespace shoal::analysis {

/// What poses problems: a behaviour with its options, and the plan of the swarm.
struct Experiment {
  std::string scenario;
  Setting behaviour;  ///< complete, as a table with `kind`
  formations::Plan plan;
  std::vector<scenarios::ObstacleOptions> obstacles;
  std::optional<Eigen::Vector2d> waypoint = std::nullopt;  ///< m

  std::unique_ptr<formations::Behaviour> make_behaviour() const;
};

/// What a vehicle knew when it posed its problems.
struct Situation {
  std::size_t experiment = 0;
  int own_slot = 0;
  formations::OwnState own;
  std::vector<formations::Neighbour> neighbours;
};

/// Problems that trials posed. Not the problems are kept but all that their behaviours need to pose
/// them again, bit for bit: so every behaviour and every cost, also your own, can be recorded.
struct Corpus {
  std::vector<Experiment> experiments;
  std::vector<Situation> situations;

  /// Adds what another corpus holds.
  void append(Corpus other);
};

/// JSON, one object a line: an experiment, or a situation of one that stands above it. The file
/// appears when it is complete. Throws SystemError.
void write_corpus(const Corpus& corpus, const std::filesystem::path& file);

/// The most that is read of a corpus: about a million situations.
inline constexpr std::size_t most_corpus_bytes = 1'000'000'000;

/// Throws InputError with file and line for anything that is no corpus, or one of more than
/// `most_bytes`.
Corpus read_corpus(const std::filesystem::path& file, std::size_t most_bytes = most_corpus_bytes);

}  // namespace shoal::analysis
