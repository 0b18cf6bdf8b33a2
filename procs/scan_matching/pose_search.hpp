// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "common/registration/correlative_search.hpp"
#include "common/registration/point_to_line.hpp"
#include "procs/scan_matching/local_reference.hpp"
#include "procs/scan_matching/motion_prediction.hpp"

namespace adit {

struct PoseSearchParams {
  PointToLineParams point_to_line;
  CorrelativeSearchParams correlative;
  double scale_measured_m = 0.08;    ///< first width of the kernel where odometry measured the step
  double trusted_score = 0.6;        ///< a match with less is doubted,
  double score_drop_max = 0.1;       ///< as is one this much worse than matches have lately been,
  double correction_max_m = 0.3;     ///< one that moved this far from the prediction,
  double correction_max_rad = 0.35;  ///< or turned this far,
  double correction_sigmas_max = 3.0;  ///< or contradicts the odometry by so many sigmas
  double search_radius_m = 1.0;        ///< half-widths of the search where a match is doubted
  double search_angle_rad = 0.7;
  double wide_radius_m = 2.5;  ///< and of a second, coarser one where the first finds nothing
  double wide_angle_rad = 2.5;
  double unknown_score = 0.5;          ///< score of a point where the reference knows nothing
  double contradiction_cost = 2.0;     ///< of a point that lies in free space
  double deviation_cost_per_m = 0.05;  ///< cost of being away from the prediction
  double deviation_cost_per_rad = 0.05;
  double deviation_cost_per_sigma2 = 0.125;  ///< the same for odometry, in points of the scan

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
    v("unknown_score", unknown_score, within(0.0, 1.0));
    v("contradiction_cost", contradiction_cost, at_least(0.0));
    v("deviation_cost_per_m", deviation_cost_per_m, at_least(0.0));
    v("deviation_cost_per_rad", deviation_cost_per_rad, at_least(0.0));
    v("deviation_cost_per_sigma2", deviation_cost_per_sigma2, at_least(0.0));
  }
};

/// A pose that the search proposes, and how good it is.
struct PoseCandidate {
  PointToLineResult match;
  double contradiction_share = 0.0;
  double sigmas = 0.0;  ///< distance from the prior, where a sensor measured the motion
  double score = 0.0;   ///< 1 for a scan that lies on the reference; comparable between candidates
};

struct PoseSearchResult {
  PoseCandidate best;
  bool searched = false;
};

/// Finds the pose of a scan on the reference: refines the prediction and, where the outcome is in
/// doubt, starts again from the peaks of a correlative search.
class PoseSearch {
 public:
  explicit PoseSearch(const PoseSearchParams& params) : params_(params) {}

  /// `typical_score`: what matches have lately scored.
  [[nodiscard]] PoseSearchResult find(const ScanObservation& observation,
                                      const LocalReference& reference,
                                      const MotionEstimate& expected, double typical_score) const;

 private:
  PoseSearchParams params_;
};

}  // namespace adit
