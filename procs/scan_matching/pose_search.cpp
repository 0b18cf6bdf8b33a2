// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace adit {
namespace {

constexpr int kPeaks = 3;
constexpr int kReachablePeaks = 12;
constexpr double kReachableM = 20.0;  // maximum half-width of the search
constexpr double kSigmasMax = 10.0;   // bounds the influence of odometry outliers

/// The search for one scan: its inputs, and the best candidate so far.
class CandidateSearch {
 public:
  CandidateSearch(const PoseSearchParams& params, const ScanObservation& observation,
                  const LocalReference& reference, const MotionEstimate& expected)
      : params_(params), observation_(observation), reference_(reference), expected_(expected) {}

  [[nodiscard]] const PoseCandidate& best() const { return best_; }
  [[nodiscard]] const std::vector<PoseCandidate>& rated() const { return rated_; }

  /// Refines `start` and keeps the result if it is new, possible and better than the best so far.
  void refine_from(const Pose2& start, double scale_m) {
    PointToLineParams refinement = params_.point_to_line;
    refinement.scale_start_m = scale_m;
    PoseCandidate candidate;
    candidate.match = match_point_to_line(observation_.points, reference_.surfels(), start,
                                          expected_.prior, refinement, &trail_);
    if (candidate.match.duplicate) return;
    if (!expected_.possible(candidate.match.T_odom_body)) return;
    rate(candidate);
    rated_.push_back(candidate);
    if (candidate.score > best_.score) best_ = candidate;
  }

  void try_peaks(double radius_m, double angle_rad, const CorrelativeSearchParams& params,
                 int peaks = kPeaks) {
    const SearchWindow window{std::min(radius_m, expected_.displacement_max_m),
                              std::min(angle_rad, expected_.turn_max_rad)};
    for (const auto& peak :
         search_correlation(observation_.points, reference_.surfels(), expected_.prior.T_odom_body,
                            window, peaks, params)) {
      refine_from(peak.T_odom_body, params_.point_to_line.scale_start_m);
    }
  }

  /// Tries all poses that the body can have reached. So many are tried that one may match by
  /// chance: it must be much better than a pose near the prediction.
  void try_reachable(const CorrelativeSearchParams& params) {
    const PoseCandidate near = best_;
    try_peaks(kReachableM, std::numbers::pi, params, kReachablePeaks);
    const bool better = best_.score >= params_.reachable_score &&
                        best_.score >= near.score + params_.reachable_gain;
    if (!better) best_ = near;
  }

  [[nodiscard]] bool is_beyond_window() const {
    return expected_.unmeasured_m > params_.search_radius_m ||
           expected_.unmeasured_rad > params_.search_angle_rad;
  }

  [[nodiscard]] bool needs_search(double typical_score) const {
    const Pose2 off = between(expected_.prior.T_odom_body, best_.match.T_odom_body);
    return !best_.match.converged || best_.score < params_.trusted_score ||
           best_.score < typical_score - params_.score_drop_max ||
           off.translation().norm() > params_.correction_max_m ||
           std::abs(off.theta) > params_.correction_max_rad ||
           best_.sigmas > params_.correction_sigmas_max;
  }

 private:
  void rate(PoseCandidate& candidate) const {
    const auto& match = candidate.match;
    const Pose2 off = between(expected_.prior.T_odom_body, match.T_odom_body);
    candidate.contradiction_share = reference_.contradiction_share(observation_, match.T_odom_body);
    candidate.sigmas = std::sqrt(off.vector().dot(expected_.prior.information * off.vector()));
    const double sigmas = std::min(candidate.sigmas, kSigmasMax);
    const double points = static_cast<double>(std::max<std::size_t>(1, observation_.points.size()));
    const double deviation_cost = params_.deviation_cost_per_m * off.translation().norm() +
                                  params_.deviation_cost_per_rad * std::abs(off.theta) +
                                  params_.deviation_cost_per_sigma2 * sigmas * sigmas / points;
    candidate.score = match.closeness + params_.unknown_score * (1.0 - match.overlap) -
                      params_.contradiction_cost * candidate.contradiction_share - deviation_cost;
  }

  const PoseSearchParams& params_;
  const ScanObservation& observation_;
  const LocalReference& reference_;
  const MotionEstimate& expected_;
  PoseCandidate best_;
  std::vector<PoseCandidate> rated_;
  MatchTrail trail_;
};

}  // namespace

PoseSearchResult PoseSearch::find(const ScanObservation& observation,
                                  const LocalReference& reference, const MotionEstimate& expected,
                                  double typical_score) const {
  CandidateSearch search(params_, observation, reference, expected);
  // Point-to-line refinement of the prediction (Lu and Milios 1997; Censi 2008).
  search.refine_from(expected.prior.T_odom_body, expected.from_odometry
                                                     ? params_.scale_measured_m
                                                     : params_.point_to_line.scale_start_m);
  const bool beyond_window = search.is_beyond_window();
  if (!beyond_window && !search.needs_search(typical_score)) return {search.best(), false};

  // Correlative search for other starts, first near the prediction, then wide (Olson 2009).
  search.try_peaks(params_.search_radius_m, params_.search_angle_rad, params_.correlative);
  CorrelativeSearchParams coarse = params_.correlative;
  coarse.cell_m *= 2.0;
  coarse.angle_step_rad *= 2.0;
  if (search.best().score < params_.trusted_score) {
    search.try_peaks(params_.wide_radius_m, params_.wide_angle_rad, coarse);
  }
  if (!beyond_window) return {search.best(), true};
  search.try_reachable(coarse);
  return {search.best(), true, true, search.rated()};
}

}  // namespace adit
