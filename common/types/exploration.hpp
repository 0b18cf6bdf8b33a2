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

/// A place in map where corridors meet or end.
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

/// A section of corridor between two nodes.
struct Corridor {
  int from = 0;  ///< index of a node
  int to = 0;
  double length_m = 0.0;
  double width_m = 0.0;                 ///< minimum width, wall to wall
  std::vector<Eigen::Vector2d> points;  ///< p_map, from node to node

  friend bool operator==(const Corridor&, const Corridor&) = default;
};

/// The centre lines of the drivable space, as a graph.
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

/// State of a frontier.
enum class FrontierState : std::int8_t {
  kOpen = 0,
  kExplored = 1,      ///< the space behind it was observed
  kBlocked = 2,       ///< the planner found no path, to it or on every route to it
  kTooNarrow = 3,     ///< no known route to it is wide enough
  kBeyondBudget = 4,  ///< open, but the round trip exceeds the budget
  kUnobservable = 5,  ///< observed from nearby without any return: water or open air
  kOutsideMine = 6,   ///< outside the mine, behind the start
  kUnconfirmed = 7,   ///< no path was found, but the obstacle was not observed
};

/// "open", "explored", ..
constexpr const char* name_of(FrontierState state) {
  switch (state) {
    case FrontierState::kOpen:
      return "open";
    case FrontierState::kExplored:
      return "explored";
    case FrontierState::kBlocked:
      return "blocked";
    case FrontierState::kTooNarrow:
      return "too narrow";
    case FrontierState::kBeyondBudget:
      return "beyond budget";
    case FrontierState::kUnobservable:
      return "unobservable";
    case FrontierState::kOutsideMine:
      return "outside mine";
    case FrontierState::kUnconfirmed:
      return "unconfirmed";
  }
  return "";
}

/// A place where the mine continues beyond the observed space, with an identity that persists while
/// the map grows and moves.
struct Frontier {
  int id = 0;                               ///< 0, 1, ... in order of detection
  int local_map = 0;                        ///< id of the local map to which it is anchored
  Eigen::Vector2d p_map{0.0, 0.0};          ///< by the current pose graph [m]
  Eigen::Vector2d direction_map{1.0, 0.0};  ///< unit vector into unobserved space
  double width_m = 0.0;                     ///< approximate width, wall to wall
  FrontierState state = FrontierState::kOpen;
  std::int64_t utime = 0;  ///< time of the change to this state [µs since the epoch]
  std::string evidence;    ///< reason for the state, a sentence

  friend bool operator==(const Frontier&, const Frontier&) = default;
};

/// True if the frontier may be visited, now or with a larger budget.
inline bool is_visitable(FrontierState state) {
  return state == FrontierState::kOpen || state == FrontierState::kBeyondBudget;
}

/// True if the frontier is no longer visited, without proof that nothing is left to explore.
inline bool is_abandoned(FrontierState state) {
  return state == FrontierState::kUnconfirmed || state == FrontierState::kUnobservable;
}

/// True if the evidence shows that nothing is left to explore.
inline bool is_closed(FrontierState state) { return !is_visitable(state) && !is_abandoned(state); }

/// The next exploration goal with its reason.
struct ExplorationDecision {
  enum class Kind : std::int8_t {
    kStay = 0,   ///< not enough data for a decision
    kGoTo = 1,   ///< along known corridors to a frontier
    kAlong = 2,  ///< from the frontier straight down the corridor, as far as possible
    kHome = 3,   ///< along known corridors to the start
    kDone = 4,   ///< at the start; exploration has ended
  };
  static constexpr int kNoFrontier = -1;

  Kind kind = Kind::kStay;
  Pose2 T_map_goal;  ///< the next goal; for kAlong its heading is the direction
  double distance_m =
      0.0;  ///< length of the route to the final destination, the frontier or the start
  int frontier = kNoFrontier;  ///< id of the target frontier
  bool complete = false;       ///< every frontier detected so far is closed
  std::string reason;          ///< a sentence

  friend bool operator==(const ExplorationDecision&, const ExplorationDecision&) = default;
};

/// Path length budget and explored length.
struct ExplorationBudget {
  double remaining_m = 0.0;
  double explored_m = 0.0;  ///< total length of the known corridors

  friend bool operator==(const ExplorationBudget&, const ExplorationBudget&) = default;
};

/// State of the exploration.
struct ExplorationReport {
  std::int64_t utime = 0;     ///< time of the newest measurement used [µs since the epoch]
  std::int64_t revision = 0;  ///< revision of the MapGraph used
  std::int32_t request = 0;   ///< id of the newest answered ExploreRequest; 0 before the first
  ExplorationDecision decision;
  Pose2 T_odom_goal;  ///< the goal of the decision in odom
  /// The next part of the route in odom, from the robot on, extended straight beyond a frontier;
  /// empty without a goal.
  std::vector<Eigen::Vector2d> route_odom;
  ExplorationBudget budget;
  std::vector<Frontier> frontiers;  ///< all frontiers detected so far, by id
  CorridorGraph corridors;

  friend bool operator==(const ExplorationReport&, const ExplorationReport&) = default;
};

/// The verdict that a target is blocked, after several failed plans from two poses.
struct BlockedVerdict {
  std::int64_t utime = 0;      ///< time of the 3D scan used [µs since the epoch]
  std::int32_t frontier = -1;  ///< the target; -1: the start
  double reached_m = 0.0;      ///< farthest reachable progress
  std::string evidence;        ///< a sentence
  bool unconfirmed = false;    ///< the obstacle was not observed, or not twice

  friend bool operator==(const BlockedVerdict&, const BlockedVerdict&) = default;
};

/// Request for the next goal. Repeated until answered; a verdict counts once for each id.
struct ExploreRequest {
  std::int64_t utime = 0;       ///< [µs since the epoch]
  std::int32_t id = 0;          ///< positive; the answer has the same id
  double remaining_m = 0.0;     ///< path length allowed by battery and time
  bool returning_home = false;  ///< only the route to the start is requested
  std::optional<BlockedVerdict> blocked;

  friend bool operator==(const ExploreRequest&, const ExploreRequest&) = default;
};

}  // namespace adit
