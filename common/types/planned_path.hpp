// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A goal for the planner, from the current pose.
struct PlanGoal {
  enum class Kind : std::int8_t {
    kAlong = 0,   ///< as far as possible in a direction: straight down the corridor
    kToPose = 1,  ///< to a pose
    kRoute = 2,   ///< as far as possible along a route, through bends and junctions of the corridor
    kRetrace = 3,  ///< back along the traversed path, regardless of the terrain map
    kRouteTo = 4,  ///< along a route to its end, with any heading; as far as possible
    kRejoin = 5,   ///< onto the traversed path as far back as possible, then back along it
  };

  static constexpr std::size_t kPointsMax =
      1000;  ///< maximum points of a route or a traversed path

  std::int64_t utime = 0;  ///< [µs since the epoch]
  std::int32_t id = 0;
  Kind kind = Kind::kAlong;
  Pose2 T_odom_goal;         ///< for kAlong its heading is the direction
  double distance_m = 10.0;  ///< maximum path length, for kAlong, kRetrace and kRejoin
  /// For kRoute and kRouteTo: from the robot on, at least two points [m].
  std::vector<Eigen::Vector2d> route_odom = {};
  /// For kRetrace and kRejoin: previous poses of the body, the newest first, at least two; with
  /// gaps where the poses were too far away to be useful.
  std::vector<Pose2> traversed_path_odom = {};

  friend bool operator==(const PlanGoal&, const PlanGoal&) = default;
};

/// A point of a path, with the segment to the next point.
struct PathPoint {
  Pose2 T_odom_body;
  double curvature_1_m = 0.0;  ///< of the segment that begins here, positive to the left
  bool reverse = false;        ///< true if the segment is driven in reverse
  double clearance_m = 0.0;    ///< from the footprint to the nearest lethal cell
  double cost = 0.0;           ///< accumulated from the start

  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

/// Outcome of planning.
enum class PlanOutcome : std::int8_t {
  kFound = 0,
  kStartBlocked = 1,  ///< the current pose is not feasible
  kBlocked = 2,       ///< observed obstacles block every path of the requested length
  kUnknown = 3,       ///< unobserved cells block every path; another scan may reveal one
  kSearchLimit = 4,   ///< the search reached its limit
  kNarrow =
      5,  ///< observed obstacles block every path, but by less than the measurement uncertainty
};

/// "found", "start_blocked", ..
constexpr const char* name_of(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::kFound:
      return "found";
    case PlanOutcome::kStartBlocked:
      return "start_blocked";
    case PlanOutcome::kBlocked:
      return "blocked";
    case PlanOutcome::kUnknown:
      return "unknown";
    case PlanOutcome::kNarrow:
      return "narrow";
    case PlanOutcome::kSearchLimit:
      return "search_limit";
  }
  return "";
}

/// A cell that blocks the path, as evidence for the operator.
struct BlockingCell {
  enum class Reason : std::int8_t {
    kStep = 0,   ///< too high under a wheel
    kBelly = 1,  ///< too high between the wheels
    kRoof = 2,
    kUnknown = 3,
    kWater = 4,
    kSlope = 5,
    kDrop = 6,  ///< below the beams that passed over it
  };

  Eigen::Vector2d p_odom{0.0, 0.0};  ///< centre of the cell [m]
  Reason reason = Reason::kStep;
  double height_m = 0.0;  ///< navigational coefficient, or the clearance for kRoof

  friend bool operator==(const BlockingCell&, const BlockingCell&) = default;
};

/// "a step under the wheels", ..
constexpr const char* description_of(BlockingCell::Reason reason) {
  switch (reason) {
    case BlockingCell::Reason::kStep:
      return "a step under the wheels";
    case BlockingCell::Reason::kBelly:
      return "an obstacle that is too high to drive over";
    case BlockingCell::Reason::kRoof:
      return "a roof that is too low";
    case BlockingCell::Reason::kUnknown:
      return "unobserved ground";
    case BlockingCell::Reason::kWater:
      return "possible water";
    case BlockingCell::Reason::kSlope:
      return "a slope that is too steep";
    case BlockingCell::Reason::kDrop:
      return "a drop";
  }
  return "";
}

/// Result of planning for one goal.
struct PlannedPath {
  std::int64_t utime =
      0;  ///< time of the terrain map, or of the goal without one [µs since the epoch]
  std::int32_t id = 0;  ///< id of the goal
  PlanOutcome outcome = PlanOutcome::kBlocked;
  std::string reason;                  ///< one sentence for the operator
  std::vector<PathPoint> points;       ///< from the robot on; empty unless found
  double reached_m = 0.0;              ///< farthest reachable progress towards the goal
  std::vector<BlockingCell> blocking;  ///< cells that block further progress; empty if found

  friend bool operator==(const PlannedPath&, const PlannedPath&) = default;
};

/// Sum of the distances between its points [m].
inline double path_length_m(const PlannedPath& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    length_m +=
        between(path.points[i - 1].T_odom_body, path.points[i].T_odom_body).translation().norm();
  }
  return length_m;
}

/// Minimum distance between footprint and lethal cells along the path [m]; infinite without a path.
inline double least_clearance_m(const PlannedPath& path) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const PathPoint& point : path.points) least_m = std::min(least_m, point.clearance_m);
  return least_m;
}

}  // namespace adit
