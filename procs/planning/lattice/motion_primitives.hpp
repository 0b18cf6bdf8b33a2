// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/heading_set.hpp"
#include "procs/planning/c_space/kernel.hpp"
#include "procs/planning/lattice/line_arc_line.hpp"

namespace adit {

/// A pose of the lattice that a primitive passes, relative to its start cell.
struct SweptPose {
  std::int16_t column;
  std::int16_t row;
  std::uint16_t heading;
  std::int32_t length_mm;  ///< length of the primitive that is charged at the cost of this pose
};

/// A motion from the centre of a cell to the centre of another, from a heading of the set to
/// another. Its ends are exact, without rounding, so that a sequence of primitives can be driven.
struct MotionPrimitive {
  int from = 0;                 ///< heading at the start
  int to = 0;                   ///< heading at the end
  Eigen::Vector2i cells{0, 0};  ///< displacement
  bool reverse = false;
  LineArcLine curve{};             ///< as driven forwards; in reverse from its end to its start
  std::int32_t length_mm = 0;      ///< sum over `swept`, with the cost factors of PrimitiveParams
  std::vector<SweptPose> swept{};  ///< without the start, the end last
  RunKernel body{};                ///< all cells that the vehicle sweeps, from the start cell
  RunKernel wheels{};              ///< all cells that its wheels sweep
};

struct PrimitiveParams {
  double step_m = 0.3;          ///< minimum length of a straight primitive
  double turn_factor = 1.05;    ///< cost of a bend relative to a straight line
  double reverse_factor = 2.0;  ///< cost of driving in reverse relative to forwards
  /// Share by which the radius of bends exceeds the turning radius of the vehicle, so that the
  /// controller can correct an error to the outside.
  double radius_reserve = 0.1;

  template <class V>
  void visit(V& v) {
    v("step_m", step_m, above_up_to(0.0, 2.0));
    v("turn_factor", turn_factor, within(1.0, 10.0));
    v("reverse_factor", reverse_factor, within(1.0, 100.0));
    v("radius_reserve", radius_reserve, within(0.0, 1.0));
  }
};

/// The motion primitives of each heading, forwards and in reverse: straight, by `step_m` and by the
/// shortest distance to the centre of a cell; a tight and a gentle bend to the next heading; tight
/// bends by a sixteenth and an eighth of a turn. Each bend changes the heading, as otherwise states
/// collapse into their parents (Nav2 issue 3172). The set is exactly symmetric under reflection
/// and rotation by π/2.
class MotionPrimitives {
 public:
  /// Throws std::invalid_argument if the turning radius of the vehicle allows no such bends.
  MotionPrimitives(const Vehicle& vehicle, const PrimitiveParams& params,
                   const HeadingSet& headings, double cell_m);

  /// The same primitives for driving with the rear leading: `reverse_factor`, with which this set
  /// was made, then applies to driving forwards.
  [[nodiscard]] MotionPrimitives rear_leading(double reverse_factor) const;

  [[nodiscard]] const HeadingSet& headings() const { return headings_; }
  /// The primitives of a heading in a fixed order, forwards first.
  [[nodiscard]] const std::vector<MotionPrimitive>& from(int heading) const {
    return from_[static_cast<std::size_t>(heading)];
  }
  /// Minimum ratio of the length of a primitive to that of its chain of neighbouring cells. It
  /// makes the cell heuristic consistent.
  [[nodiscard]] double length_ratio_min() const { return length_ratio_min_; }
  /// Maximum reach of the swept kernels [cells].
  [[nodiscard]] int reach() const;
  /// Pose of the body at an arc length, relative to the centre of the start cell.
  [[nodiscard]] Pose2 pose_at(const MotionPrimitive& primitive, double distance_m) const;
  /// Curvature of the path of the body's origin after an arc length, positive to the left [1/m].
  [[nodiscard]] double curvature_at(const MotionPrimitive& primitive, double distance_m) const;

 private:
  [[nodiscard]] Pose2 forward_pose(const MotionPrimitive& primitive, double distance_m) const;
  [[nodiscard]] MotionPrimitive straight(int heading, double step_m) const;
  [[nodiscard]] MotionPrimitive bend(int heading, int turn, double radius_min_m) const;
  void sweep(MotionPrimitive& primitive, double factor);
  void cover(MotionPrimitive& primitive) const;
  void add_bends(int heading, int turn, const PrimitiveParams& params);
  /// Adds a primitive, its images under the symmetries of the lattice, and all of these in reverse.
  /// A primitive that is its own mirror image (`is_symmetric`) is not mirrored.
  void add_with_symmetries(MotionPrimitive primitive, bool is_symmetric,
                           const PrimitiveParams& params);

  HeadingSet headings_;
  double cell_m_;
  Vehicle vehicle_;
  double axle_m_;        ///< distance of the point that moves along x behind the body's origin
  double radius_min_m_;  ///< of the path of that point
  double length_ratio_min_ = 1.0;
  std::vector<std::vector<MotionPrimitive>> from_;
};

}  // namespace adit
