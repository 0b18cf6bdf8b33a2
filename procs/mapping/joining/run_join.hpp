// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/types/association.hpp"
#include "procs/mapping/joining/run_alignment.hpp"

namespace adit {

struct RunJoinParams {
  RunAlignmentParams alignment;
  double apart_m = 4.0;  ///< distance between local maps that are searched, and searched in
  /// Share of the length of walls that both maps observed that may contradict the join: walls of
  /// one in the free space of the other.
  double contradicting_max = 0.05;
  /// Limit of the distance between walls of both, by that between walls of one run where its local
  /// maps overlap: ratio, and what is added. The ratio is 0.9 to 1.0 for parts of one public log
  /// and runs of one simulated mine, 7 for rough walls of simulated mines with the same plan.
  /// Distance: third quartile, less the median, since a laser may be off by a constant.
  double walls_apart_ratio = 2.0;
  double walls_apart_added_m = 0.005;

  template <class V>
  void visit(V& v) {
    v("alignment", alignment);
    v("apart_m", apart_m, above(0.0));
    v("contradicting_max", contradicting_max, within(0.0, 1.0));
    v("walls_apart_ratio", walls_apart_ratio, above(0.0));
    v("walls_apart_added_m", walls_apart_added_m, at_least(0.0));
  }
};

/// A loop closure between a run and the map that it was joined to.
struct JoinLink {
  int older = 0;  ///< ids of local maps in the joined map
  int newer = 0;
  Pose2 T_older_newer;
  double log_likelihood = 0.0;
  /// Of (x, y, θ) in the frame of the newer map; zero in directions that it leaves open.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

/// Where a run may lie in a map.
struct PossibleJoin {
  RunAlignment alignment;
  std::vector<LoopClosure> agreeing;  ///< their newer maps by the ids of the run
};

/// Whether a run was joined to a map, and the evidence.
struct RunJoin {
  bool joined = false;
  std::string reason;  ///< a short sentence for the operator
  int first_map = 0;   ///< of the run, in the joined map
  int session = 0;     ///< its first
  Pose2 T_map_run;     ///< by the links that agree, before the optimisation

  int searched = 0;              ///< pairs of local maps that were matched at any pose
  int found = 0;                 ///< possible poses that fix all directions
  int agreeing = 0;              ///< of these, those that agree with one alignment
  int places = 0;                ///< distinct places of the evidence of the links in force
  int rivals = 0;                ///< other alignments that were tried
  double observed_m = 0.0;       ///< length of walls that both sides observed at the final poses,
  double contradicting_m = 0.0;  ///< of these, in free space of the other side
  double walls_apart_m = 0.0;    ///< distance between walls of both
  double own_apart_m = 0.0;      ///< the same within the map or within the run, the larger one
  bool walls_agree = false;      ///< within both limits
  int rejected = 0;              ///< loop closures that the joined map excludes
  std::vector<JoinLink> links;   ///< in force

  [[nodiscard]] double contradicting_share() const {
    return observed_m > 0.0 ? contradicting_m / observed_m : 0.0;
  }
};

}  // namespace adit
