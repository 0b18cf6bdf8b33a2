// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/relief.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// A curve through points, level beyond its ends: smooth and monotonicity-preserving, by cubic
/// Hermite interpolation with the slopes of Fritsch and Butland ("A method for constructing local
/// monotone piecewise cubic interpolants", 1984) and slope 0 at its ends, or linear.
class HeightProfile {
 public:
  enum class Grade { kSmooth, kSudden };
  /// The value of a key `grade`.
  static Grade grade_named(const std::string& name) {
    return name == "sudden" ? Grade::kSudden : Grade::kSmooth;
  }

  /// `profile_m` is s, z, s, z, ..; empty gives 0 everywhere. Throws std::invalid_argument for an
  /// odd list, for s that does not ascend, and for heights beyond 5000 m.
  explicit HeightProfile(const std::vector<double>& profile_m, Grade grade = Grade::kSmooth);

  [[nodiscard]] double at(double s_m) const;

 private:
  struct Knot {
    double s_m = 0.0;
    double z_m = 0.0;
    double slope = 0.0;
  };
  void set_slopes();

  Grade grade_;
  std::vector<Knot> knots_;
};

/// Change of the floor or the roof by a prop, within a rectangle of the plan.
struct HeightChange {
  Eigen::Vector2d low{0.0, 0.0};   ///< corner of the rectangle, p_world [m]
  Eigen::Vector2d high{0.0, 0.0};  ///< the opposite one
  /// Maps the height at a point [m] to the new height.
  std::function<double(const Eigen::Vector2d& p_world, double height_m)> apply;
};

/// Heights of floor and roof as functions of the plan, inside and outside of the mine. Frame world.
class Heights {
 public:
  /// Throws std::invalid_argument for a profile that does not ascend.
  Heights(const HeightsDescription& description, int seed);

  void change_floor(HeightChange change) { floor_changes_.push_back(std::move(change)); }
  void change_roof(HeightChange change) { roof_changes_.push_back(std::move(change)); }

  [[nodiscard]] double floor(const Eigen::Vector2d& p_world) const;
  /// At least 5 cm above the floor.
  [[nodiscard]] double roof(const Eigen::Vector2d& p_world) const;

 private:
  /// Height of the floor without relief and changes.
  [[nodiscard]] double base(const Eigen::Vector2d& p_world) const;

  HeightProfile profile_;
  Eigen::Vector2d heading_;
  double clearance_m_;
  Relief floor_relief_;
  Relief roof_relief_;
  std::vector<HeightChange> floor_changes_;
  std::vector<HeightChange> roof_changes_;
};

}  // namespace adit
