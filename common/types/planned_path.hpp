// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Where the robot is to go, from where it is.
struct PlanGoal {
  enum class Kind : std::int8_t {
    kAlong = 0,    ///< as far as possible in a direction: straight down the corridor
    kToPose = 1,   ///< to a pose
    kRoute = 2,    ///< as far as possible along a route, on which the corridor bends and branches
    kRetrace = 3,  ///< back on the own track, whatever the terrain seems to be
    kRouteTo = 4,  ///< along a route to its end, a place, with any heading; as far as possible
    kRejoin = 5,   ///< onto the own track where it is farthest back, and from there back on it
  };

  static constexpr std::size_t kPointsMax = 1000;  ///< of a route, and of a track

  std::int64_t utime = 0;  ///< [µs since the epoch]
  std::int32_t id = 0;
  Kind kind = Kind::kAlong;
  Pose2 T_odom_goal;         ///< the pose; of kAlong its heading is the direction
  double distance_m = 10.0;  ///< of kAlong, and on a track: how far at most
  std::vector<Eigen::Vector2d> route_odom =
      {};  ///< of kRoute and kRouteTo: from the robot on, two places at least [m]
  /// Of kRetrace and kRejoin: where the body was, from where it is back, two poses at least; with
  /// gaps where it was too far away to be of use.
  std::vector<Pose2> traversed_path_odom = {};

  friend bool operator==(const PlanGoal&, const PlanGoal&) = default;
};

/// A place on a path, on the way to the next.
struct PathPoint {
  Pose2 T_odom_body;
  double curvature_1_m = 0.0;  ///< of the stretch that begins here, positive to the left
  bool reverse = false;        ///< whether that stretch is driven backwards
  double clearance_m = 0.0;    ///< from the footprint to the nearest lethal cell
  double cost = 0.0;           ///< from the start

  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

/// Why there is a path, or none.
enum class PlanOutcome : std::int8_t {
  kFound = 0,
  kStartBlocked = 1,  ///< the robot cannot stand where it is
  kBlocked = 2,       ///< what is seen leaves no way of the length that is asked
  kUnknown = 3,       ///< what is not seen leaves none; another scan may show one
  kSearchLimit = 4,   ///< the search was cut off by its limit
  kNarrow = 5,        ///< what is seen leaves none, but by less than can be told
};

/// A cell that is in the way, as evidence for a person.
struct BlockingCell {
  enum class Reason : std::int8_t {
    kStep = 0,   ///< under a wheel
    kBelly = 1,  ///< between the wheels
    kRoof = 2,
    kUnknown = 3,
    kWater = 4,
    kSlope = 5,
    kDrop = 6,  ///< lower than beams that passed over it
  };

  Eigen::Vector2d p_odom{0.0, 0.0};  ///< its middle [m]
  Reason reason = Reason::kStep;
  double height_m = 0.0;  ///< of what is in the way: coefficient, or clearance for a roof

  friend bool operator==(const BlockingCell&, const BlockingCell&) = default;
};

/// The answer of the planner.
struct PlannedPath {
  std::int64_t utime = 0;  ///< of the terrain it rests on, or else of the goal [µs since the epoch]
  std::int32_t id = 0;     ///< of the goal it answers
  PlanOutcome outcome = PlanOutcome::kBlocked;
  std::string reason;                  ///< one sentence for people
  std::vector<PathPoint> points;       ///< from the robot on; empty unless found
  double reached_m = 0.0;              ///< farthest progress towards the goal that is possible
  std::vector<BlockingCell> blocking;  ///< what stopped it there; empty where found

  friend bool operator==(const PlannedPath&, const PlannedPath&) = default;
};

}  // namespace adit
