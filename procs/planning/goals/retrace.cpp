// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/retrace.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "procs/planning/goals/connecting_curve.hpp"

namespace adit {
namespace {

constexpr double kLengthMinM = 0.5;
constexpr double kPoseSpacingM = 0.05;  // closer poses do not define the direction of travel
constexpr double kGapM = 0.5;           // maximum distance of consecutive poses
constexpr double kBesideM = 0.3;        // of the traversed path beside a vehicle that gets onto it
constexpr double kJoinM = 3.0;          // of it, in which it does
constexpr double kCurveSpacingM = 0.1;  // of poses up to there

/// By which a pose may be off an arc from the one before.
struct Tolerance {
  double beside_m;
  double heading_rad;
};
constexpr Tolerance kAsExactAsAPath{kOnPathM, kOnPathRad};
// Where scan matching was uncertain, as across a smooth tunnel, the traversed path jitters by this.
constexpr Tolerance kWithJitter{0.25, 0.25};

using Poses = std::vector<Pose2>;

double distance_between(const Pose2& T_odom_a, const Pose2& T_odom_b) {
  return (T_odom_b.translation() - T_odom_a.translation()).norm();
}

bool is_on_path(const Pose2& T_odom_end, const Pose2& T_odom_traversed) {
  return distance_between(T_odom_end, T_odom_traversed) <= kOnPathM &&
         std::abs(angle_diff(T_odom_end.theta, T_odom_traversed.theta)) <= kOnPathRad;
}

/// Whether the vehicle gets from one pose to the next, up to a tolerance: the traversed path itself
/// joins poses that differ by the accuracy of a path where the robot came back to an earlier one.
bool is_drivable(const Pose2& T_odom_a, const Pose2& T_odom_b, double turning_radius_m,
                 const Tolerance& tolerance) {
  const Pose2 step = between(T_odom_a, T_odom_b);
  const double step_m = step.translation().norm();
  if (std::abs(step.theta) > step_m / turning_radius_m + tolerance.heading_rad) return false;
  // The chord of an arc bisects the headings at its ends.
  const Pose2 along_chord{0.0, 0.0, 0.5 * step.theta};
  return std::abs((along_chord.inverse() * step.translation()).y()) <= tolerance.beside_m;
}

/// Where a vehicle gets onto the traversed path, at its next pose if it can, and the poses up to
/// there, that one included; none if it cannot.
struct Joined {
  Poses poses;
  Poses::const_iterator at;
};
Joined joined(const Pose2& T_odom_from, Poses::const_iterator next, Poses::const_iterator end,
              double turning_radius_m, const Tolerance& tolerance) {
  if (is_drivable(T_odom_from, *next, turning_radius_m, tolerance)) return {{*next}, next};
  double along_m = distance_between(T_odom_from, *next);
  if (std::abs(between(T_odom_from, *next).y) > kBesideM) return {};
  for (; next != end && along_m <= kJoinM; ++next) {
    Poses curve = connecting_curve(T_odom_from, *next, turning_radius_m, kCurveSpacingM);
    if (!curve.empty()) return {std::move(curve), next};
    if (next + 1 == end) break;
    const double step_m = distance_between(*next, *(next + 1));
    if (step_m > kGapM) break;
    along_m += step_m;
  }
  return {};
}

/// `T_odom_start`, followed by the traversed path from `next` up to a gap, a pose that the vehicle
/// cannot get to, or a length.
Poses continuous_part(const Pose2& T_odom_start, Poses::const_iterator next,
                      Poses::const_iterator end, double length_m, double turning_radius_m,
                      const Tolerance& tolerance) {
  Poses poses{T_odom_start};
  double distance_m = 0.0;
  for (; next != end && distance_m < length_m; ++next) {
    const double step_m = distance_between(poses.back(), *next);
    if (step_m > kGapM) break;
    if (step_m < kPoseSpacingM) continue;
    const Joined onto = joined(poses.back(), next, end, turning_radius_m, tolerance);
    if (onto.poses.empty()) break;
    for (const Pose2& pose : onto.poses) {
      distance_m += distance_between(poses.back(), pose);
      poses.push_back(pose);
    }
    next = onto.at;
  }
  return poses;
}

double length_of(const Poses& poses) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length_m += distance_between(poses[i - 1], poses[i]);
  return length_m;
}

/// The continuous part with jitter only where there is none without.
Poses drivable_part(const Pose2& T_odom_start, Poses::const_iterator next,
                    Poses::const_iterator end, double length_m, double turning_radius_m) {
  Poses exact =
      continuous_part(T_odom_start, next, end, length_m, turning_radius_m, kAsExactAsAPath);
  if (length_of(exact) >= kLengthMinM) return exact;
  return continuous_part(T_odom_start, next, end, length_m, turning_radius_m, kWithJitter);
}

/// The path point of the segment from a pose to the next; `cost` is that of the path up to it.
PathPoint segment_point(const Pose2& T_odom_body, const Pose2& T_odom_next, double cost) {
  const Pose2 step = between(T_odom_body, T_odom_next);
  const bool reverse = step.x < 0.0;
  const double curvature = step.theta / step.translation().norm() * (reverse ? -1.0 : 1.0);
  return {T_odom_body, curvature, reverse, kRetracedClearanceM, cost};
}

/// Appends poses; the first one is the end of the path so far, or its start.
void append(std::vector<PathPoint>& points, const Poses& poses, double cost) {
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    points.push_back(segment_point(poses[i], poses[i + 1], cost));
    cost += distance_between(poses[i], poses[i + 1]);
  }
  points.push_back({poses.back(), 0.0, points.back().reverse, kRetracedClearanceM, cost});
}

}  // namespace

PlannedPath retrace(const PlanGoal& goal, const Pose2& T_odom_body, double turning_radius_m) {
  const Poses poses =
      drivable_part(T_odom_body, goal.traversed_path_odom.begin(), goal.traversed_path_odom.end(),
                    goal.distance_m, turning_radius_m);
  PlannedPath path;
  path.utime = goal.utime;
  path.id = goal.id;
  path.reason = "There is no traversed path to retrace.";
  if (poses.size() < 2) return path;
  append(path.points, poses, 0.0);
  path.reached_m = path.points.back().cost;
  if (path.reached_m < kLengthMinM) {
    path.points.clear();
    return path;
  }
  path.outcome = PlanOutcome::kFound;
  path.reason = "Along the traversed path.";
  return path;
}

void append_traversed_path(PlannedPath& path, const PlanGoal& goal, double turning_radius_m) {
  if (path.points.empty()) return;
  const PathPoint end = path.points.back();
  const auto last =
      std::find_if(goal.traversed_path_odom.rbegin(), goal.traversed_path_odom.rend(),
                   [&](const Pose2& T_odom) { return is_on_path(end.T_odom_body, T_odom); });
  const Poses poses = drivable_part(end.T_odom_body, last.base(), goal.traversed_path_odom.end(),
                                    goal.distance_m, turning_radius_m);
  if (last == goal.traversed_path_odom.rend() || poses.size() < 2) return;
  path.points.pop_back();
  append(path.points, poses, end.cost);
  path.reached_m += path.points.back().cost - end.cost;
  path.reason = "Onto the traversed path and along it.";
}

}  // namespace adit
