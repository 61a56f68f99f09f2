#pragma once

#include "shoal/formations/obstacle.hpp"

namespace shoal::formations {

// Sizes are in metres and above zero; angles are of the first half axis, in radians,
// counter-clockwise from x.

/// At the centre the normal is (1, 0).
class Circle final : public Obstacle {
 public:
  Circle(const Eigen::Vector2d& centre, double radius) : centre_(centre), radius_(radius) {}
  Eigen::Vector2d centre() const override { return centre_; }
  Proximity nearest(const Eigen::Vector2d& place) const override;

 private:
  Eigen::Vector2d centre_;
  double radius_;
};

/// A shape that is symmetric about two axes of its own: the transform T_i of Barisic et al. 2011
/// leads a place into their frame, and turns a normal back.
class TurnedShape : public Obstacle {
 public:
  Eigen::Vector2d centre() const override { return centre_; }
  Proximity nearest(const Eigen::Vector2d& place) const final;

 protected:
  TurnedShape(const Eigen::Vector2d& centre, double angle);

  /// In the frame of the shape, of a place in its first quadrant. `rounding` is how well that place
  /// is known (m).
  virtual Proximity nearest_in_quadrant(const Eigen::Vector2d& place, double rounding) const = 0;

 private:
  Eigen::Vector2d centre_;
  Eigen::Vector2d axis_;  // unit vector
};

/// Where two sides are equally near, the normal is that of the end of the first axis; on an axis of
/// symmetry, that of the positive side; in a corner, that of the end of the first axis.
class Rectangle final : public TurnedShape {
 public:
  Rectangle(const Eigen::Vector2d& centre, double half_length, double half_width, double angle)
      : TurnedShape(centre, angle), half_(half_length, half_width) {}

 protected:
  Proximity nearest_in_quadrant(const Eigen::Vector2d& place, double rounding) const override;

 private:
  Eigen::Vector2d half_;
};

/// On the longer axis, between the centres of curvature of its ends, the nearest point is the one
/// on the positive side of that axis.
class Ellipse final : public TurnedShape {
 public:
  Ellipse(const Eigen::Vector2d& centre, double half_length, double half_width, double angle)
      : TurnedShape(centre, angle), half_(half_length, half_width) {}

 protected:
  Proximity nearest_in_quadrant(const Eigen::Vector2d& place, double rounding) const override;

 private:
  Eigen::Vector2d half_;
};

}  // namespace shoal::formations
