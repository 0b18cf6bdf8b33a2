// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "procs/mapping/association/association_problem.hpp"

namespace adit {

/// Where a session of the map may lie instead of where it does. Between smooth or repeating walls
/// the first local map of a session fits at several places of an older session, and its choice
/// between them may be wrong.
struct SessionRival {
  int first = 0;  ///< the first local map of the session
  int end = 0;    ///< the first one after it; of the newest session any later one
  Pose2 shift;    ///< of the session: pose of local map `first` there, in `first` here
  /// Log-odds of the session being here, by its link to the session before and by matches. Those of
  /// one local map with several older ones count as one, since they share its errors; those of
  /// different local maps add up.
  double log_odds = 0.0;

  [[nodiscard]] double probability() const;
};

/// The rivals of all sessions but the first that are not yet refuted, by the alternatives of their
/// loop closures with older sessions. `first_maps`: of each session, ascending.
std::vector<SessionRival> session_rivals(const AssociationProblem& problem,
                                         const Hypothesis& hypothesis,
                                         const std::vector<int>& first_maps);

/// What a rival adds to the covariance of the pose of a map in the older sessions, (x, y, θ) in the
/// frame of the map: the second moment of the two places about the present one. Zero for a map
/// before the session, and for a rival so improbable that an interval of 95 % leaves it out.
Eigen::Matrix3d moment_of(const SessionRival& rival, const Hypothesis& hypothesis, int map);

/// The covariance to be added to the prediction of a map of the session, so that a search within
/// `sigmas` of it includes the rival.
Eigen::Matrix3d spread_to(const SessionRival& rival, const Hypothesis& hypothesis, int map,
                          double sigmas);

}  // namespace adit
