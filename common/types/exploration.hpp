// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A place where corridors meet or end, in map.
struct CorridorNode {
  enum class Kind : std::int8_t {
    kJunction = 0,
    kDeadEnd = 1,
    kOpenEnd = 2,
  };

  Eigen::Vector2d p_map{0.0, 0.0};
  Kind kind = Kind::kJunction;

  friend bool operator==(const CorridorNode&, const CorridorNode&) = default;
};

/// A stretch of corridor between two nodes.
struct Corridor {
  int from = 0;  ///< index of a node
  int to = 0;
  double length_m = 0.0;
  double width_m = 0.0;                 ///< the least, from wall to wall
  std::vector<Eigen::Vector2d> points;  ///< p_map, from node to node

  friend bool operator==(const Corridor&, const Corridor&) = default;
};

/// The middles of what can be driven, as a graph.
struct CorridorGraph {
  std::vector<CorridorNode> nodes;
  std::vector<Corridor> corridors;

  [[nodiscard]] double length_m() const {
    double length = 0.0;
    for (const Corridor& corridor : corridors) length += corridor.length_m;
    return length;
  }

  friend bool operator==(const CorridorGraph&, const CorridorGraph&) = default;
};

/// What became of a place where the mine goes on.
enum class FrontierState : std::int8_t {
  kOpen = 0,
  kExplored = 1,      ///< what lies there was seen
  kBlocked = 2,       ///< the planner found no way, here or on every way here
  kTooNarrow = 3,     ///< no known way there is wide enough
  kBeyondBudget = 4,  ///< open, but too far to go there and come home
  kUnobservable = 5,  ///< seen from close by, and nothing came back: water, or open air
  kOutsideMine = 6,   ///< outside of the mine, behind the start
  kUnconfirmed = 7,   ///< no way was found, but what would be in it was not seen
};

/// A place where the mine goes on, with an identity that it keeps while the map grows and moves.
struct Frontier {
  int id = 0;                               ///< 0, 1, ... in the order in which they were seen
  int local_map = 0;                        ///< to which it is tied
  Eigen::Vector2d p_map{0.0, 0.0};          ///< by the present graph [m]
  Eigen::Vector2d direction_map{1.0, 0.0};  ///< into what was not seen, a unit vector
  double width_m = 0.0;                     ///< from wall to wall, about
  FrontierState state = FrontierState::kOpen;
  std::int64_t utime = 0;  ///< when it came into that state [µs since the epoch]
  std::string evidence;    ///< for that state, a sentence

  friend bool operator==(const Frontier&, const Frontier&) = default;
};

/// Whether one may go there, now or with more budget.
inline bool is_visitable(FrontierState state) {
  return state == FrontierState::kOpen || state == FrontierState::kBeyondBudget;
}

/// Whether nobody goes there any more, though nobody saw that there is nothing to be done.
inline bool is_abandoned(FrontierState state) {
  return state == FrontierState::kUnconfirmed || state == FrontierState::kUnobservable;
}

/// Whether it is known that nothing is left to be done there.
inline bool is_closed(FrontierState state) { return !is_visitable(state) && !is_abandoned(state); }

/// Where to go next, and why.
struct ExplorationDecision {
  enum class Kind : std::int8_t {
    kStay = 0,   ///< nothing can be said yet
    kGoTo = 1,   ///< along known corridors, to a stub
    kAlong = 2,  ///< from the stub on as far as possible straight down the corridor
    kHome = 3,   ///< along known corridors, to the start
    kDone = 4,   ///< at home, and there to stay
  };
  static constexpr int kNoFrontier = -1;

  Kind kind = Kind::kStay;
  Pose2 T_map_goal;            ///< the next goal; of kAlong its heading is the direction
  double distance_m = 0.0;     ///< along the way to where it leads in the end: the stub, or home
  int frontier = kNoFrontier;  ///< the target
  bool complete = false;       ///< every stub ever seen is closed
  std::string reason;          ///< a sentence

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
  std::vector<Frontier> frontiers;  ///< all that were ever seen, by id
  CorridorGraph corridors;

  friend bool operator==(const ExplorationReport&, const ExplorationReport&) = default;
};

/// What a planner said who found no path, several times, from two poses.
struct BlockedVerdict {
  std::int64_t utime = 0;      ///< of the scan it rests on [µs since the epoch]
  std::int32_t frontier = -1;  ///< that it was to go to; -1 on the way home
  double reached_m = 0.0;      ///< farthest progress that was possible
  std::string evidence;        ///< a sentence
  bool unconfirmed = false;    ///< what would be in the way was not seen, or not twice

  friend bool operator==(const BlockedVerdict&, const BlockedVerdict&) = default;
};

/// Where to go next? Repeated until it is answered; a verdict counts once for each id.
struct ExploreRequest {
  std::int64_t utime = 0;       ///< [µs since the epoch]
  std::int32_t id = 0;          ///< that the answer is to have, positive
  double remaining_m = 0.0;     ///< way that battery and time still allow
  bool returning_home = false;  ///< nothing but the way home is asked for
  std::optional<BlockedVerdict> blocked;

  friend bool operator==(const ExploreRequest&, const ExploreRequest&) = default;
};

}  // namespace adit
