// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/pose_search.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr int kPeaks = 3;
constexpr double kSigmasMax = 10.0;  // an outlier of the odometry must not outvote the scan

/// One scan's search: what it is about, and the best candidate so far.
class Quest {
 public:
  Quest(const PoseSearchParams& params, const Sighting& sighting, const LocalReference& reference,
        const MotionEstimate& expected)
      : params_(params), sighting_(sighting), reference_(reference), expected_(expected) {}

  [[nodiscard]] const PoseCandidate& best() const { return best_; }

  /// Refines `start` and keeps the outcome if it is new, possible and better than what there was.
  void try_from(const Pose2& start, double scale_m) {
    PointToLineParams refinement = params_.point_to_line;
    refinement.scale_start_m = scale_m;
    PoseCandidate candidate;
    candidate.match = match_point_to_line(sighting_.points, reference_.surfels(), start,
                                          expected_.prior, refinement, &trail_);
    if (candidate.match.joined) return;
    if (!expected_.possible(candidate.match.T_odom_body)) return;
    rate(candidate);
    if (candidate.score > best_.score) best_ = candidate;
  }

  void try_peaks(double radius_m, double angle_rad, const CorrelativeSearchParams& how) {
    const SearchWindow window{std::min(radius_m, expected_.reach_m),
                              std::min(angle_rad, expected_.reach_rad)};
    for (const auto& peak : search_correlation(sighting_.points, reference_.surfels(),
                                               expected_.prior.T_odom_body, window, kPeaks, how)) {
      try_from(peak.T_odom_body, params_.point_to_line.scale_start_m);
    }
  }

  [[nodiscard]] bool doubted(double typical_score) const {
    const Pose2 off = between(expected_.prior.T_odom_body, best_.match.T_odom_body);
    return !best_.match.converged || best_.score < params_.trusted_score ||
           best_.score < typical_score - params_.doubt_margin ||
           off.translation().norm() > params_.doubt_distance_m ||
           std::abs(off.theta) > params_.doubt_angle_rad || best_.sigmas > params_.doubt_sigmas;
  }

 private:
  void rate(PoseCandidate& candidate) const {
    const auto& match = candidate.match;
    const Pose2 off = between(expected_.prior.T_odom_body, match.T_odom_body);
    candidate.contradiction_share = reference_.contradiction_share(sighting_, match.T_odom_body);
    candidate.sigmas = std::sqrt(off.vector().dot(expected_.prior.information * off.vector()));
    const double sigmas = std::min(candidate.sigmas, kSigmasMax);
    const double points = static_cast<double>(std::max<std::size_t>(1, sighting_.points.size()));
    const double surprise = params_.surprise_per_m * off.translation().norm() +
                            params_.surprise_per_rad * std::abs(off.theta) +
                            params_.surprise_per_sigma2 * sigmas * sigmas / points;
    candidate.score = match.closeness + params_.unseen_credit * (1.0 - match.overlap) -
                      params_.contradiction_cost * candidate.contradiction_share - surprise;
  }

  const PoseSearchParams& params_;
  const Sighting& sighting_;
  const LocalReference& reference_;
  const MotionEstimate& expected_;
  PoseCandidate best_;
  MatchTrail trail_;
};

}  // namespace

PoseSearchResult PoseSearch::find(const Sighting& sighting, const LocalReference& reference,
                                  const MotionEstimate& expected, double typical_score) const {
  Quest quest(params_, sighting, reference, expected);
  quest.try_from(expected.prior.T_odom_body, expected.from_odometry
                                                 ? params_.scale_measured_m
                                                 : params_.point_to_line.scale_start_m);
  if (!quest.doubted(typical_score)) return {quest.best(), false};

  quest.try_peaks(params_.search_radius_m, params_.search_angle_rad, params_.correlative);
  if (quest.best().score < params_.trusted_score) {
    CorrelativeSearchParams coarse = params_.correlative;
    coarse.cell_m *= 2.0;
    coarse.angle_step_rad *= 2.0;
    quest.try_peaks(params_.wide_radius_m, params_.wide_angle_rad, coarse);
  }
  return {quest.best(), true};
}

}  // namespace adit
