// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/config/bounds.hpp"
#include "common/registration/correlative_search.hpp"
#include "common/registration/point_to_line.hpp"
#include "procs/scan_matching/local_reference.hpp"
#include "procs/scan_matching/motion/motion_prediction.hpp"

namespace adit {

struct PoseSearchParams {
  PointToLineParams point_to_line;
  CorrelativeSearchParams correlative;
  double scale_measured_m = 0.08;      ///< initial kernel width if odometry measured the step
  double trusted_score = 0.6;          ///< the search starts for a match with a lower score,
  double score_drop_max = 0.1;         ///< or this much below the recent scores,
  double correction_max_m = 0.3;       ///< moved this far from the prediction,
  double correction_max_rad = 0.35;    ///< turned this far from it,
  double correction_sigmas_max = 3.0;  ///< or this many sigmas from the odometry
  double search_radius_m = 1.0;        ///< half-widths of the search window
  double search_angle_rad = 0.7;
  double wide_radius_m = 2.5;  ///< half-widths of a second, coarser search if the first fails
  double wide_angle_rad = 2.5;
  /// Of the poses that the body can have reached unmeasured, beyond the first window: minimum
  /// score,
  double reachable_score = 0.6;
  double reachable_gain = 0.05;        ///< and minimum gain over the pose near the prediction
  double unknown_score = 0.5;          ///< score of a point in unobserved space
  double contradiction_cost = 2.0;     ///< cost of a point in free space
  double deviation_cost_per_m = 0.05;  ///< cost of the deviation from the prediction
  double deviation_cost_per_rad = 0.05;
  /// The same for the odometry prior, in points of the scan.
  double deviation_cost_per_sigma2 = 0.125;

  template <class V>
  void visit(V& v) {
    v("point_to_line", point_to_line);
    v("correlative", correlative);
    v("scale_measured_m", scale_measured_m, above(0.0));
    v("trusted_score", trusted_score, within(0.0, 1.0));
    v("score_drop_max", score_drop_max, within(0.0, 1.0));
    v("correction_max_m", correction_max_m, above(0.0));
    v("correction_max_rad", correction_max_rad, above(0.0));
    v("correction_sigmas_max", correction_sigmas_max, above(0.0));
    v("search_radius_m", search_radius_m, above_up_to(0.0, 20.0));
    v("search_angle_rad", search_angle_rad, above_up_to(0.0, 3.2));
    v("wide_radius_m", wide_radius_m, above_up_to(0.0, 20.0));
    v("wide_angle_rad", wide_angle_rad, above_up_to(0.0, 3.2));
    v("reachable_score", reachable_score, within(0.0, 1.0));
    v("reachable_gain", reachable_gain, within(0.0, 1.0));
    v("unknown_score", unknown_score, within(0.0, 1.0));
    v("contradiction_cost", contradiction_cost, at_least(0.0));
    v("deviation_cost_per_m", deviation_cost_per_m, at_least(0.0));
    v("deviation_cost_per_rad", deviation_cost_per_rad, at_least(0.0));
    v("deviation_cost_per_sigma2", deviation_cost_per_sigma2, at_least(0.0));
  }
};

/// A pose proposed by the search, with its score.
struct PoseCandidate {
  PointToLineResult match;
  double contradiction_share = 0.0;
  double sigmas = 0.0;  ///< distance from the prior, if a sensor measured the motion
  double score = 0.0;   ///< 1 for a scan on the reference; comparable between candidates
};

struct PoseSearchResult {
  PoseCandidate best;
  bool searched = false;
  bool complete = false;  ///< all poses were searched that the body can have reached
  /// The possible ones among the poses of a complete search, in the order of rating.
  std::vector<PoseCandidate> reachable{};
};

/// Finds the pose of a scan in the reference: refines the prediction and, if the result is in
/// doubt, restarts from the peaks of a correlative search. If no sensor measured the motion and the
/// body can have left the window of this search since the last scan, all poses are searched that it
/// can have reached: a prediction by the last speed says nothing about a turn in between.
class PoseSearch {
 public:
  explicit PoseSearch(const PoseSearchParams& params) : params_(params) {}

  /// `typical_score`: running mean of recent scores.
  [[nodiscard]] PoseSearchResult find(const ScanObservation& observation,
                                      const LocalReference& reference,
                                      const MotionEstimate& expected, double typical_score) const;

 private:
  PoseSearchParams params_;
};

}  // namespace adit
