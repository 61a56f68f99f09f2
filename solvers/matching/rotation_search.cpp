#include "shoal/solvers/matching/rotation_search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shoal/core/angles.hpp"
#include "shoal/core/error.hpp"
#include "shoal/core/interruption.hpp"
#include "shoal/core/text.hpp"
#include "shoal/solvers/matching/points.hpp"

namespace shoal::solvers {
namespace {

constexpr double division_tolerance = 1e-9;
constexpr int turns_unchecked = 4;

}  // namespace

Turns::Turns(double step_deg) : step_deg_(step_deg) {
  if (!(step_deg > 0.0 && step_deg <= 360.0)) {
    throw InputError("a rotation step of " + shortest(step_deg) +
                     " degrees: it must be above 0 and at most 360");
  }
  const int count = static_cast<int>(std::floor(360.0 / step_deg + division_tolerance));
  for (int turn = 0; turn < count; ++turn) {
    cosine_.push_back(std::cos(angle(turn)));
    sine_.push_back(std::sin(angle(turn)));
  }
}

double Turns::angle(int turn) const {
  return radians((turn + 1) * step_deg_);
}

bool Turns::permuted_by(double angle_deg) const {
  const auto divided = [this](double degrees) {
    const double quotient = degrees / step_deg_;
    return std::abs(quotient - std::round(quotient)) <= division_tolerance;
  };
  return divided(angle_deg) && (divided(360.0) || angle_deg == 0.0);
}

AlignedSlots::AlignedSlots(std::span<const Eigen::Vector2d> slots, const Eigen::Vector2d& centre) {
  const auto count = static_cast<Eigen::Index>(slots.size());
  x.resize(count);
  y.resize(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Vector2d placed = slots[static_cast<std::size_t>(j)] - centre;
    x[j] = placed.x();
    y[j] = placed.y();
  }
  radius = (x.square() + y.square()).sqrt();
  std::sort(radius.begin(), radius.end());
}

void RotationSearch::set_points(std::span<const Eigen::Vector2d> points) {
  turned_step_deg_ = 0.0;
  own_order_.assign(points.begin(), points.end());
  points_.clear();
  for (const Eigen::Vector2d& p : points) points_.push_back({p.x(), p.y(), p.norm()});
  std::sort(points_.begin(), points_.end(),
            [](const Point& a, const Point& b) { return a.radius > b.radius; });
}

// |p - q| is at least the difference of their radii. The matching of sorted radii that is cheapest
// keeps their order, so with d slots too many the i-th radius meets one of the i-th to (i+d)-th.
double RotationSearch::bound_below(const AlignedSlots& slots) const {
  const auto count = static_cast<Eigen::Index>(points_.size());
  const Eigen::Index spare = slots.radius.size() - count;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < count && spare >= 0; ++i) {
    const double radius = points_[static_cast<std::size_t>(count - 1 - i)].radius;
    double nearest = infinity;
    for (Eigen::Index j = i; j <= i + spare; ++j) {
      nearest = std::min(nearest, std::abs(slots.radius[j] - radius));
    }
    sum += nearest;
  }
  return sum;
}

TurnedMatch RotationSearch::search(const Turns& turns, const AlignedSlots& slots, double limit,
                                   double margin) {
  cost_of_turn_.clear();
  const int rows = static_cast<int>(points_.size());
  if (rows > slots.size()) throw std::invalid_argument("rotation search: more points than slots");

  turn_few(turns);
  glance(slots, limit);
  // Round the circle from the most promising turn, so that the prices of one turn fit the next.
  Eigen::Index first = 0;
  if (glance_.minCoeff(&first) > limit) return {};
  cost_of_turn_.assign(static_cast<std::size_t>(turns.count()), infinity);
  costs_.resize(points_.size() * static_cast<std::size_t>(slots.size()));
  assignment_.reset(rows, slots.size());
  double least = infinity;
  for (int step = 0; step < turns.count(); ++step) {
    const int turn = (static_cast<int>(first) + step) % turns.count();
    if (glance_[turn] > limit) continue;
    if (step % turns_unchecked == turns_unchecked - 1) check_interruption();
    if (!fill_costs(slots, turns.cosine(turn), turns.sine(turn), limit)) continue;
    if (assignment_.solve_similar(costs_, limit) != AssignmentStatus::optimal) continue;
    cost_of_turn_[static_cast<std::size_t>(turn)] = assignment_.cost();
    least = std::min(least, assignment_.cost());
    limit = std::min(limit, least + margin + cost_tie_m);
  }
  if (least == infinity) return {};
  std::size_t winner = 0;
  while (cost_of_turn_[winner] > least + cost_tie_m) ++winner;
  return {static_cast<int>(winner), cost_of_turn_[winner]};
}

void RotationSearch::match(const Turns& turns, const AlignedSlots& slots, int turn) {
  const double cosine = turns.cosine(turn);
  const double sine = turns.sine(turn);
  const Eigen::Index columns = slots.size();
  costs_.resize(own_order_.size() * static_cast<std::size_t>(slots.size()));
  double* row = costs_.data();
  for (const Eigen::Vector2d& p : own_order_) {
    const double x = cosine * p.x() - sine * p.y();
    const double y = sine * p.x() + cosine * p.y();
    Eigen::Map<Eigen::ArrayXd>(row, columns) =
        ((slots.x - x).square() + (slots.y - y).square()).sqrt();
    row += columns;
  }
  const auto status = assignment_.solve(costs_, static_cast<int>(own_order_.size()), slots.size());
  if (status != AssignmentStatus::optimal) {
    throw std::invalid_argument("rotation search: more points than slots, or not finite");
  }
}

void RotationSearch::turn_few(const Turns& turns) {
  if (turned_step_deg_ == turns.step_deg()) return;
  constexpr std::size_t few = 4;
  const auto count = static_cast<Eigen::Index>(std::min(few, points_.size()));
  turned_x_.resize(turns.count(), count);
  turned_y_.resize(turns.count(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point& p = points_[static_cast<std::size_t>(i)];
    for (int turn = 0; turn < turns.count(); ++turn) {
      const double cosine = turns.cosine(turn), sine = turns.sine(turn);
      turned_x_(turn, i) = static_cast<float>(cosine * p.x - sine * p.y);
      turned_y_(turn, i) = static_cast<float>(sine * p.x + cosine * p.y);
    }
  }
  turned_step_deg_ = turns.step_deg();
}

// A lower bound for little work: the nearest slots of the farthest points, all turns at once, until
// every turn costs too much.
void RotationSearch::glance(const AlignedSlots& slots, double limit) {
  glance_.setZero(turned_x_.rows());
  if (points_.empty()) return;
  // What the rounding of coordinates to floats may add to a distance.
  const double reach = slots.radius[slots.radius.size() - 1] + points_.front().radius;
  const auto rounding = static_cast<float>(8.0 * std::numeric_limits<float>::epsilon() * reach);
  nearest_.resize(turned_x_.rows());
  for (Eigen::Index i = 0; i < turned_x_.cols() && glance_.minCoeff() <= limit; ++i) {
    nearest_.setConstant(std::numeric_limits<float>::max());
    for (Eigen::Index j = 0; j < slots.size(); ++j) {
      const auto x = static_cast<float>(slots.x[j]), y = static_cast<float>(slots.y[j]);
      nearest_ = nearest_.min((turned_x_.col(i) - x).square() + (turned_y_.col(i) - y).square());
    }
    glance_ += nearest_.sqrt() - rounding;
  }
}

// Gives up as soon as the prices of the last assignment prove that this one costs more.
bool RotationSearch::fill_costs(const AlignedSlots& slots, double cosine, double sine,
                                double limit) {
  const Eigen::Index columns = slots.size();
  const Eigen::Map<const Eigen::ArrayXd> prices(assignment_.prices().data(), columns);
  // Distances are not negative, so a row's share is at least minus the highest price.
  const double share = -assignment_.highest_price();
  double bound = assignment_.price_sum() + share * static_cast<double>(points_.size());
  double* row = costs_.data();
  for (const Point& p : points_) {
    const double x = cosine * p.x - sine * p.y;
    const double y = sine * p.x + cosine * p.y;
    Eigen::Map<Eigen::ArrayXd> distances(row, columns);
    distances = ((slots.x - x).square() + (slots.y - y).square()).sqrt();
    bound += (distances - prices).minCoeff() - share;
    if (bound > limit) return false;
    row += columns;
  }
  return true;
}

}  // namespace shoal::solvers
