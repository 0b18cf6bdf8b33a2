// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// The point of the body that moves along the body's x axis, as a unicycle: the origin with
/// four-wheel steering (both axles by the same angle, to opposite sides), the centre of the rear
/// axle with Ackermann steering. The controllers steer this point.
class SteeredPoint {
 public:
  /// Throws std::invalid_argument for Ackermann steering if the turning radius of the origin is at
  /// most half the wheelbase.
  explicit SteeredPoint(const Vehicle& vehicle);

  /// The pose of the point, with the heading of the body.
  [[nodiscard]] Pose2 pose(const Pose2& T_odom_body) const;
  /// The pose of the body from that of the point.
  [[nodiscard]] Pose2 body(const Pose2& T_odom_steered) const;
  /// Maximum curvature of the path of the point [1/m].
  [[nodiscard]] double curvature_max_1_m() const { return curvature_max_1_m_; }
  /// Curvature of the path of the body's origin, as in commands, from that of the point.
  [[nodiscard]] double curvature_of_origin(double curvature_1_m) const;

 private:
  double x_m_ = 0.0;  ///< in the body frame
  double curvature_max_1_m_;
};

/// A part of a path that is driven in one direction: a polyline of the steered point, parametrised
/// by arc length.
class PathRun {
 public:
  struct Knot {
    double s_m = 0.0;
    Pose2 T_odom_steered;  ///< the heading is not wrapped, so that it can be interpolated
    double clearance_m = 0.0;
  };

  /// At least one knot, with increasing arc length.
  PathRun(std::vector<Knot> knots, bool reverse);

  [[nodiscard]] double length_m() const { return knots_.back().s_m; }
  /// 1, or −1 in reverse.
  [[nodiscard]] double direction() const { return direction_; }
  /// The pose at an arc length. Beyond the end the run continues with its last curvature.
  [[nodiscard]] Pose2 at(double s_m) const;
  /// The smaller clearance of the two knots of the segment.
  [[nodiscard]] double clearance_m(double s_m) const;
  /// Mean curvature between two arc lengths, positive to the left: the change of the heading, which
  /// is exact for any spacing of the knots. The interval is clamped to the run.
  [[nodiscard]] double curvature_1_m(double from_m, double to_m) const;
  /// Arc length of the point nearest to `p_odom` between two arc lengths.
  [[nodiscard]] double nearest_s_m(const Eigen::Vector2d& p_odom, double from_m, double to_m) const;

 private:
  [[nodiscard]] Pose2 extrapolate_past_end(double distance_m) const;
  /// Index of the knot at the end of the segment at an arc length; 0 for a single knot.
  [[nodiscard]] std::size_t segment_end(double s_m) const;

  std::vector<Knot> knots_;
  double direction_;
};

/// Splits a path where the direction of travel changes. Points less than 1 mm from their
/// predecessor are left out. There must be at least one point, and all must be finite.
std::vector<PathRun> split_into_runs(const std::vector<PathPoint>& points,
                                     const SteeredPoint& steered);

/// The run with a continuous curvature: each pose is the mean over a window of `blend_m`, which
/// narrows towards the ends, so that these stay in place. A jump of the curvature becomes a ramp of
/// that length, centred on the jump; a bend of curvature κ is cut by κ blend²/24. Where the
/// clearance exceeds `clearance_m` the window widens gradually up to `wide_m`, at 5 cm more: with
/// 0.6 m the tightest bend is cut by 1 cm.
PathRun blended(const PathRun& run, double blend_m, double wide_m, double clearance_m);

/// The position of the robot on its path. It never decreases and is searched only a short distance
/// ahead, so that a path that crosses itself or changes direction is driven in order.
class PathProgress {
 public:
  static constexpr double kSearchAheadM = 0.5;

  /// At least one run.
  explicit PathProgress(std::vector<PathRun> runs);

  /// Advances to the point of the run nearest to the robot.
  void advance(const Pose2& T_odom_steered);
  /// False if the current run is the last.
  bool begin_next_run();

  [[nodiscard]] const PathRun& run() const { return runs_[run_]; }
  /// Arc length on the current run.
  [[nodiscard]] double s_m() const { return s_m_; }
  [[nodiscard]] double run_remaining_m() const { return run().length_m() - s_m_; }
  /// On the complete path.
  [[nodiscard]] double distance_travelled_m() const { return completed_runs_m_ + s_m_; }
  [[nodiscard]] double remaining_m() const;
  [[nodiscard]] PathTrackingError error(const Pose2& T_odom_steered) const;
  /// Distance from the point on the run; more than the lateral error before the start of the run
  /// and beyond its end.
  [[nodiscard]] double distance_m(const Pose2& T_odom_steered) const;

 private:
  std::vector<PathRun> runs_;
  std::size_t run_ = 0;
  double s_m_ = 0.0;
  double completed_runs_m_ = 0.0;  ///< length of the completed runs
};

}  // namespace adit
