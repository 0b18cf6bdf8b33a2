// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// One way in which two local maps may lie on each other: a peak of their correlation.
struct LoopClosureAlternative {
  int older_map = 0;  ///< id of the local map that is revisited
  Pose2 T_older_newer;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of it: (x, y, θ) in the newer frame
  double log_likelihood = 0.0;  ///< of the overlap, against that of no overlap at all

  friend bool operator==(const LoopClosureAlternative&, const LoopClosureAlternative&) = default;
};

/// A decision to be made: with which older map, if any, does this one coincide, and how.
struct LoopClosure {
  int id = 0;  ///< 0, 1, … in the order in which they arose
  int newer_map = 0;
  std::vector<LoopClosureAlternative>
      alternatives;  ///< most likely first; "none" is always one more

  friend bool operator==(const LoopClosure&, const LoopClosure&) = default;
};

/// What was decided about a closure, when, and why: the record of lazy data association.
struct Association {
  enum class Action : std::int8_t {
    kProposed = 0,  ///< a new closure, with its first decision
    kRevised = 1,   ///< an earlier decision is replaced
  };
  static constexpr int kNone = -1;  ///< chosen: no alternative

  std::int64_t utime = 0;  ///< time of the newest measurement when it was decided
  Action action = Action::kProposed;
  LoopClosure loop_closure;
  int chosen = kNone;             ///< index into closure.alternatives
  int previously_chosen = kNone;  ///< the same before a revision
  double log_likelihood = 0.0;    ///< of all measurements under all decisions, after this one
  std::string reason;             ///< a short sentence

  friend bool operator==(const Association&, const Association&) = default;
};

}  // namespace adit
