// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/exploration/corridor_graph.hpp"
#include "common/exploration/stub.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// Where to go next, and why.
struct ExplorationDecision {
  enum class Kind : std::int8_t {
    kStay = 0,   ///< nothing can be said yet
    kGoTo = 1,   ///< along known corridors, to a stub
    kAlong = 2,  ///< from the stub on as far as possible straight down the corridor
    kHome = 3,   ///< along known corridors, to the start
    kDone = 4,   ///< at home, and there to stay
  };
  static constexpr int kNoStub = -1;

  Kind kind = Kind::kStay;
  Pose2 T_map_goal;         ///< the next goal; of kAlong its heading is the direction
  double distance_m = 0.0;  ///< along the way to where it leads in the end: the stub, or home
  int stub = kNoStub;       ///< the target
  bool complete = false;    ///< every stub ever seen is closed
  std::string reason;       ///< a sentence

  friend bool operator==(const ExplorationDecision&, const ExplorationDecision&) = default;
};

/// What there is left, in metres of way.
struct ExplorationBudget {
  double remaining_m = 0.0;
  double home_m = 0.0;      ///< way home from here
  double explored_m = 0.0;  ///< length of all corridors that are known

  friend bool operator==(const ExplorationBudget&, const ExplorationBudget&) = default;
};

/// The exploration as it stands.
struct ExplorationReport {
  std::int64_t utime = 0;     ///< of the newest measurement in it [µs since the epoch]
  std::int64_t revision = 0;  ///< of the MapGraph that it rests on
  std::int32_t request = 0;   ///< newest ExploreRequest that it answers; 0 before the first
  ExplorationDecision decision;
  Pose2 T_odom_goal;  ///< the goal of the decision in odom
  /// The next of the way in odom, from the robot on, and beyond a stub straight on; empty where
  /// there is nowhere to go.
  std::vector<Eigen::Vector2d> route_odom;
  ExplorationBudget budget;
  std::vector<Stub> stubs;  ///< all that were ever seen, by id
  CorridorGraph corridors;

  friend bool operator==(const ExplorationReport&, const ExplorationReport&) = default;
};

}  // namespace adit
