#pragma once

#include <chrono>
#include <limits>
#include <vector>

namespace shoal::solvers {

/// The progress of a solve: the lowest cost so far that keeps to the constraints, each time that it
/// fell. Of a solver that starts several times, all starts together.
class Trace {
 public:
  struct Point {
    int evaluations;  ///< of the cost, so far
    double seconds;   ///< since the trace began
    double cost;
  };

  /// Begins it anew.
  void begin() { *this = {}; }

  void count_evaluation() { ++evaluations_; }
  void note(double cost) {
    if (!(cost < lowest_)) return;
    lowest_ = cost;
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begin_;
    points_.push_back({evaluations_, since.count(), cost});
  }

  const std::vector<Point>& points() const { return points_; }

 private:
  std::vector<Point> points_;
  double lowest_ = std::numeric_limits<double>::infinity();
  int evaluations_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace shoal::solvers
