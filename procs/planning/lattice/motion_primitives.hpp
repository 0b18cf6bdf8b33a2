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

/// A cell and a heading on the way of a primitive.
struct SweptPose {
  std::int16_t column;  ///< from the cell where it begins
  std::int16_t row;     ///< likewise
  std::uint16_t heading;
  std::int32_t length_mm;  ///< of the primitive, that is driven at this pose's cost
};

/// A piece of driving from the middle of a cell to the middle of another, from a heading of the set
/// to another, without any rounding in between: a path of primitives is one that can be driven.
struct MotionPrimitive {
  int from = 0;  ///< heading
  int to = 0;
  Eigen::Vector2i cells{0, 0};  ///< displacement
  bool reverse = false;
  LineArcLine curve{};         ///< as driven forwards; in reverse from its end to its beginning
  std::int32_t length_mm = 0;  ///< in all
  std::vector<SweptPose>
      swept{};         ///< all that it comes through, its end last, without its beginning
  RunKernel body{};    ///< all cells that the vehicle comes over, from the one where it begins
  RunKernel wheels{};  ///< likewise its wheels
};

struct PrimitiveParams {
  double step_m = 0.3;          ///< of driving straight on, at least
  double turn_factor = 1.05;    ///< a way round a bend costs this many times a straight one
  double reverse_factor = 2.0;  ///< likewise in reverse
  /// By which bends are wider than the vehicle can do, so that driving can make up for an error to
  /// the outside.
  double radius_reserve = 0.1;

  template <class V>
  void visit(V& v) {
    v("step_m", step_m, above_up_to(0.0, 2.0));
    v("turn_factor", turn_factor, within(1.0, 10.0));
    v("reverse_factor", reverse_factor, within(1.0, 100.0));
    v("radius_reserve", radius_reserve, within(0.0, 1.0));
  }
};

/// What the robot can drive from each heading: straight on, by a step and by as little as leads to
/// the middle of a cell, and bends by one heading, tight and
/// gentle, and tight ones by a sixteenth and an eighth of a turn; forwards and in reverse. A bend
/// ends at another heading than it begins, always, or states would collapse into their parents
/// (Nav2 3172). The set is the same when it is mirrored or turned by a right angle, exactly.
class MotionPrimitives {
 public:
  /// Throws std::invalid_argument where the vehicle has no such bends.
  MotionPrimitives(const Vehicle& vehicle, const PrimitiveParams& params,
                   const HeadingSet& headings, double cell_m);

  /// The same for going back with the rear leading: `reverse_factor`, that of these, is then the
  /// price of driving forwards.
  [[nodiscard]] MotionPrimitives rear_leading(double reverse_factor) const;

  [[nodiscard]] const HeadingSet& headings() const { return headings_; }
  /// In order, forwards first.
  [[nodiscard]] const std::vector<MotionPrimitive>& from(int heading) const {
    return from_[static_cast<std::size_t>(heading)];
  }
  /// Least way of a primitive for that of the shortest chain of neighbouring cells it comes
  /// through.
  [[nodiscard]] double length_ratio_min() const { return least_way_share_; }
  /// Of their kernels, the greatest.
  [[nodiscard]] int reach() const;
  /// Pose of the body at a way along a primitive, from the middle of the cell where it begins.
  [[nodiscard]] Pose2 pose_at(const MotionPrimitive& primitive, double distance_m) const;
  /// Of the path of the body's origin for the stretch that begins there, positive to the left.
  [[nodiscard]] double curvature_at(const MotionPrimitive& primitive, double distance_m) const;

 private:
  [[nodiscard]] Pose2 forward_pose(const MotionPrimitive& primitive, double distance_m) const;
  [[nodiscard]] MotionPrimitive straight(int heading, double step_m) const;
  [[nodiscard]] MotionPrimitive bend(int heading, int turn, double radius_min_m) const;
  void sweep(MotionPrimitive& primitive, double factor);
  void cover(MotionPrimitive& primitive) const;
  void add_bends(int heading, int turn, const PrimitiveParams& params);
  /// And its images, and all of these in reverse.
  void add_with_symmetries(MotionPrimitive primitive, bool is_symmetric,
                           const PrimitiveParams& params);

  HeadingSet headings_;
  double cell_m_;
  Vehicle vehicle_;
  double axle_m_;        ///< of the point that moves along x, behind the body's origin
  double radius_min_m_;  ///< of the path of that point
  double least_way_share_ = 1.0;
  std::vector<std::vector<MotionPrimitive>> from_;
};

}  // namespace adit
