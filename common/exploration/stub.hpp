// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace adit {

/// What became of a place where the mine goes on.
enum class StubState : std::int8_t {
  kOpen = 0,
  kExplored = 1,      ///< what lies there was seen
  kBlocked = 2,       ///< the planner found no way, here or on every way here
  kTooNarrow = 3,     ///< no known way there is wide enough
  kBeyondBudget = 4,  ///< open, but too far to go there and come home
  kUnseeable = 5,     ///< seen from close by, and nothing came back: water, or open air
  kWayOut = 6,        ///< outside of the mine, behind the start
  kDoubtful = 7,      ///< no way was found, but what would be in it was not seen
};

/// A place where the mine goes on, with an identity that it keeps while the map grows and moves.
struct Stub {
  int id = 0;                               ///< 0, 1, ... in the order in which they were seen
  int local_map = 0;                        ///< to which it is tied
  Eigen::Vector2d p_map{0.0, 0.0};          ///< by the present graph [m]
  Eigen::Vector2d direction_map{1.0, 0.0};  ///< into what was not seen, a unit vector
  double width_m = 0.0;                     ///< from wall to wall, about
  StubState state = StubState::kOpen;
  std::int64_t utime = 0;  ///< when it came into that state [µs since the epoch]
  std::string evidence;    ///< for that state, a sentence

  friend bool operator==(const Stub&, const Stub&) = default;
};

/// Whether one may go there, now or with more budget.
inline bool is_to_visit(StubState state) {
  return state == StubState::kOpen || state == StubState::kBeyondBudget;
}

/// Whether nobody goes there any more, though nobody saw that there is nothing to be done.
inline bool is_given_up(StubState state) {
  return state == StubState::kDoubtful || state == StubState::kUnseeable;
}

/// Whether it is known that nothing is left to be done there.
inline bool is_closed(StubState state) { return !is_to_visit(state) && !is_given_up(state); }

}  // namespace adit
