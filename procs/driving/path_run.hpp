// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// The point of the body that moves along the body's x axis: the origin with four-wheel steering
/// (both axles alike, to opposite sides), the middle of the rear axle with Ackermann steering. It
/// moves as a unicycle does, and so what is steered is always this point.
class SteeredPoint {
 public:
  /// Throws std::invalid_argument for Ackermann steering with a turning radius of the origin of
  /// half the wheelbase or less, which has no such path.
  explicit SteeredPoint(const Vehicle& vehicle);

  /// The same heading, at the point.
  [[nodiscard]] Pose2 pose(const Pose2& T_odom_body) const;
  /// Greatest of the path of the point [1/m].
  [[nodiscard]] double curvature_max_1_m() const { return curvature_max_1_m_; }
  /// Of the path of the body's origin, as commands have it, where that of the point is given.
  [[nodiscard]] double curvature_of_origin(double curvature_1_m) const;

 private:
  double x_m_ = 0.0;  ///< in the body frame
  double curvature_max_1_m_;
};

/// A part of a path that is driven in one direction: a line from point to point of the steered
/// point, its places counted in metres from its beginning.
class PathRun {
 public:
  struct Knot {
    double s_m = 0.0;
    Pose2 T_odom_steered;  ///< heading not wrapped, so that it can be interpolated
    double clearance_m = 0.0;
  };

  /// At least one knot, with ways that increase.
  PathRun(std::vector<Knot> knots, bool reverse);

  [[nodiscard]] double length_m() const { return knots_.back().s_m; }
  /// 1, or −1 in reverse.
  [[nodiscard]] double direction() const { return direction_; }
  /// Behind its end it goes on as it bends at last.
  [[nodiscard]] Pose2 at(double s_m) const;
  /// The least that is said of the stretch.
  [[nodiscard]] double clearance_m(double s_m) const;
  /// Mean curvature between two places of the run, positive to the left: how much the heading
  /// changes, and so exact however far apart the points are. What is beyond the run does not count.
  [[nodiscard]] double curvature_1_m(double from_m, double to_m) const;
  /// The place nearest to a point, among those between two places of the run.
  [[nodiscard]] double nearest_s_m(const Eigen::Vector2d& p_odom, double from_m, double to_m) const;

 private:
  [[nodiscard]] Pose2 extrapolate_past_end(double distance_m) const;
  /// Index of the knot that ends the stretch of a place; 0 with one knot only.
  [[nodiscard]] std::size_t segment_end(double s_m) const;

  std::vector<Knot> knots_;
  double direction_;
};

/// Cut where the direction of travel changes. Points less than a millimetre from the one before are
/// left out. Points must be finite, and at least one.
std::vector<PathRun> split_into_runs(const std::vector<PathPoint>& points,
                                     const SteeredPoint& steered);

/// The same run as it can be steered: each place, its heading too, is the mean over `blend_m` of
/// the way around, less near the ends, which stay where they are. A jump Δκ of the curvature
/// becomes a ramp of that length, half of it before; in return a bend is cut by κ blend²/24.
PathRun blended(const PathRun& run, double blend_m);

/// How far along its path the robot is. Never goes back, and looks only a little ahead of where it
/// was, so that a path that crosses itself or turns back is driven in order.
class PathProgress {
 public:
  static constexpr double kSearchAheadM = 0.5;  ///< ahead, for the nearest place of the run

  /// At least one run.
  explicit PathProgress(std::vector<PathRun> runs);

  /// To the place of the run nearest to the robot.
  void advance(const Pose2& T_odom_steered);
  /// False where this is the last.
  bool begin_next_run();

  [[nodiscard]] const PathRun& run() const { return runs_[run_]; }
  /// On the run.
  [[nodiscard]] double s_m() const { return s_m_; }
  [[nodiscard]] double run_remaining_m() const { return run().length_m() - s_m_; }
  /// Of the whole path.
  [[nodiscard]] double distance_travelled_m() const { return completed_runs_m_ + s_m_; }
  [[nodiscard]] double remaining_m() const;
  [[nodiscard]] PathTrackingError error(const Pose2& T_odom_steered) const;
  /// From the place on the run: more than the error beside it before its beginning, behind its end.
  [[nodiscard]] double distance_m(const Pose2& T_odom_steered) const;

 private:
  std::vector<PathRun> runs_;
  std::size_t run_ = 0;
  double s_m_ = 0.0;
  double completed_runs_m_ = 0.0;  ///< of the runs before
};

}  // namespace adit
