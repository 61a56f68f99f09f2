#include "shoal/formations/plan.hpp"

#include <algorithm>
#include <numeric>

#include "shoal/core/grid_index.hpp"
#include "shoal/core/text.hpp"

namespace shoal::formations {
namespace {

constexpr double coincident_m = 1e-3;
constexpr double farthest_m = 1e7;  // a quarter of the way round the earth
constexpr std::size_t names_in_a_message = 24;

std::vector<int> sorted_by(std::span<const std::string> names) {
  std::vector<int> order(names.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [names](int i) -> const std::string& {
    return names[static_cast<std::size_t>(i)];
  });
  return order;
}

std::string listed_in_short(std::span<const std::string> names) {
  if (names.size() <= names_in_a_message) return listed(names);
  std::vector<std::string> words(names.begin(), names.begin() + names_in_a_message);
  words.push_back(std::to_string(names.size() - names_in_a_message) + " more");
  return listed(words);
}

}  // namespace

std::optional<std::pair<int, int>> same_name(std::span<const std::string> names) {
  std::optional<std::pair<int, int>> first;
  const std::vector<int> order = sorted_by(names);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const std::pair<int, int> pair{order[k - 1], order[k]};
    const bool same =
        names[static_cast<std::size_t>(pair.first)] == names[static_cast<std::size_t>(pair.second)];
    if (same && (!first || pair.second < first->second)) first = pair;
  }
  return first;
}

std::optional<std::pair<int, int>> same_place(std::span<const Eigen::Vector2d> points) {
  std::vector<double> x(points.size()), y(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = points[i].x();
    y[i] = points[i].y();
  }
  GridIndex index;
  index.build(x, y, coincident_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::optional<std::size_t> twin;
    index.near(x[i], y[i], [&](std::size_t j) {
      if (j < i && !twin && (points[i] - points[j]).norm() < coincident_m) twin = j;
    });
    if (twin) return std::pair{static_cast<int>(*twin), static_cast<int>(i)};
  }
  return std::nullopt;
}

Plan::Plan(std::vector<std::string> names, std::vector<Eigen::Vector2d> slots, const Origin& origin)
    : names_(std::move(names)), slots_(std::move(slots)), by_name_(sorted_by(names_)) {
  if (names_.size() != slots_.size()) {
    throw InputError(origin, "the plan has " + std::to_string(names_.size()) + " names for " +
                                 std::to_string(slots_.size()) + " slots");
  }
  if (slots_.empty()) throw InputError(origin, "the plan has no slots; give it one per vehicle");
  for (int i = 0; i < size(); ++i) {
    if (name(i).empty()) {
      throw InputError(origin, "slot " + std::to_string(i + 1) + " of the plan has no name");
    }
    if (!(slot(i).cwiseAbs().maxCoeff() <= farthest_m) || !slot(i).allFinite()) {
      throw InputError(origin, "slot " + name(i) + " of the plan is at (" + shortest(slot(i).x()) +
                                   ", " + shortest(slot(i).y()) +
                                   ") m; give it coordinates of at most " + shortest(farthest_m) +
                                   " m");
    }
  }
  if (const auto pair = same_name(names_)) {
    throw InputError(origin, "the plan has two slots named " + name(pair->first) +
                                 "; every vehicle needs one slot of its own");
  }
  if (const auto pair = same_place(slots_)) {
    throw InputError(origin, "slots " + name(pair->first) + " and " + name(pair->second) +
                                 " of the plan are at the same place, (" +
                                 shortest(slot(pair->first).x()) + ", " +
                                 shortest(slot(pair->first).y()) + ") m; move one of them");
  }
}

int Plan::index_of(std::string_view name, const Origin& origin) const {
  const auto found = std::ranges::lower_bound(
      by_name_, name, {}, [this](int i) { return std::string_view(this->name(i)); });
  if (found != by_name_.end() && this->name(*found) == name) return *found;
  throw InputError(origin, "the plan has no slot named \"" + std::string(name) + "\"; it has " +
                               listed_in_short(names_));
}

Plan Plan::centred() const {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& slot : slots_) mean += slot / static_cast<double>(size());
  Plan moved = *this;
  for (Eigen::Vector2d& slot : moved.slots_) slot -= mean;
  return moved;
}

}  // namespace shoal::formations
