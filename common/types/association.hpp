// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// One hypothesis for a loop closure: a peak of the correlation of two local maps.
struct LoopClosureAlternative {
  int older_map = 0;  ///< id of the revisited local map
  Pose2 T_older_newer;
  Eigen::Matrix3d information =
      Eigen::Matrix3d::Zero();  ///< of T_older_newer: (x, y, θ) in the newer frame
  double log_likelihood = 0.0;  ///< of the overlap, relative to no overlap

  friend bool operator==(const LoopClosureAlternative&, const LoopClosureAlternative&) = default;
};

/// A loop closure to decide: which older map, if any, overlaps the newer one, and with which
/// relative pose.
struct LoopClosure {
  int id = 0;  ///< 0, 1, … in order of detection
  int newer_map = 0;
  std::vector<LoopClosureAlternative>
      alternatives;  ///< most likely first; "none" is always a further alternative

  friend bool operator==(const LoopClosure&, const LoopClosure&) = default;
};

/// A decision on a loop closure with time and reason: the record of lazy data association.
struct Association {
  enum class Action : std::int8_t {
    kProposed = 0,  ///< a new loop closure, with its first decision
    kRevised = 1,   ///< replaces an earlier decision
  };
  static constexpr int kNone = -1;  ///< value of `chosen` for no alternative

  std::int64_t utime = 0;  ///< time of the newest measurement at the decision
  Action action = Action::kProposed;
  LoopClosure loop_closure;
  int chosen = kNone;             ///< index into loop_closure.alternatives
  int previously_chosen = kNone;  ///< the choice before a revision
  double log_likelihood = 0.0;    ///< of all measurements given all decisions, after this one
  std::string reason;             ///< a short sentence for the operator

  /// Whether a loop closure that was in force has none of its alternatives any more.
  [[nodiscard]] bool revokes() const {
    return action == Action::kRevised && chosen == kNone && previously_chosen != kNone;
  }

  friend bool operator==(const Association&, const Association&) = default;
};

}  // namespace adit
