// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/scan_matching.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace adit {
namespace {}  // namespace

ScanMatching::ScanMatching(const ScanMatchingParams& params)
    : params_(params), motion_(params.motion), reference_(params.reference) {}

ScanMatching::Candidate ScanMatching::refine(const Sighting& sighting, const Pose2& start,
                                             const PosePrior& prior, double scale) const {
  Candidate c;
  PointToLineParams how = params_.point_to_line;
  how.scale_start_m = scale;
  c.match = match_point_to_line(sighting.points, reference_, start, prior, how);
  const Pose2 T_key_body = between(T_odom_keyframe_, c.match.T_odom_body);
  const int inside =
      keyframe_space_.count_inside(sighting.points, T_key_body, params_.contradiction_margin_m) +
      sighting.space.count_inside(keyframe_points_, T_key_body.inverse(),
                                  params_.contradiction_margin_m);
  c.contradiction = static_cast<double>(inside) /
                    std::max<std::size_t>(1, sighting.points.size() + keyframe_points_.size());
  const Pose2 off = between(prior.T_odom_body, c.match.T_odom_body);
  c.score = c.match.closeness + params_.unseen_credit * (1.0 - c.match.overlap) -
            2.0 * c.contradiction - params_.surprise_m * off.translation().norm() -
            params_.surprise_rad * std::abs(off.theta);
  c.surprise = off.vector().dot(prior.information * off.vector());
  c.score -= params_.prior_weight * std::min(c.surprise, 100.0) /
             std::max<std::size_t>(1, sighting.points.size());
  return c;
}

ScanMatching::Candidate ScanMatching::match(const Sighting& sighting,
                                            const MotionEstimate& expected, ScanMatch& out) {
  const Pose2& start = expected.prior.T_odom_body;
  Candidate best =
      refine(sighting, start, expected.prior,
             expected.from_odometry ? params_.narrow_m : params_.point_to_line.scale_start_m);
  const Pose2 slid = between(start, best.match.T_odom_body);
  const bool far = slid.translation().norm() > params_.search_motion_m ||
                   std::abs(slid.theta) > params_.search_motion_rad;
  if (!motion_.possible(between(T_odom_body_, best.match.T_odom_body),
                        1e-6 * (out.utime - out.reference_utime)))
    best.score = -1;
  const bool surprised = best.surprise > 9.0;
  if (best.score >= std::max(params_.trusted_inlier_share, typical_ - params_.doubt_margin) &&
      best.match.converged && !far && !surprised)
    return best;
  out.searched = true;
  const auto search = [&](const SearchWindow& window, const CorrelativeSearchParams& how) {
    for (const auto& peak :
         search_correlation(sighting.points, reference_, start, window, 3, how)) {
      const auto candidate =
          refine(sighting, peak.T_odom_body, expected.prior, params_.peak_scale_m);
      if (!motion_.possible(between(T_odom_body_, candidate.match.T_odom_body),
                            1e-6 * (out.utime - out.reference_utime)))
        continue;
      if (candidate.score > best.score) best = candidate;
    }
  };
  const double dt = 1e-6 * static_cast<double>(out.utime - out.reference_utime);
  const double reach_m = 0.3 + params_.motion.speed_max_m_s * dt;
  const double reach_rad = 0.3 + params_.motion.yaw_rate_max_rad_s * dt;
  search(
      {std::min(reach_m, params_.search_radius_m), std::min(reach_rad, params_.search_angle_rad)},
      params_.correlative_search);
  if (best.score < params_.wide_score) {
    CorrelativeSearchParams wide = params_.correlative_search;
    wide.cell_m *= 2.0;
    wide.angle_step_rad *= 2.0;
    search({std::min(reach_m, params_.wide_radius_m), std::min(reach_rad, params_.wide_angle_rad)},
           wide);
  }
  return best;
}

ScanMatch ScanMatching::add_scan(const LaserMount& mount, const LaserScan& scan) {
  ScanMatch out;
  out.utime = scan.utime;
  out.reference_utime = utime_;
  if (started_ && scan.utime <= utime_) return out;
  const Sighting sighting{surface_points(scan, mount, params_.surface), FreeSpace(scan, mount)};
  const auto& points = sighting.points;
  out.points = static_cast<int>(points.size());
  const auto expected = motion_.predict(scan.utime);
  if (!started_) {
    out.status = MatchStatus::kFirstScan;
    out.T_odom_body = T_odom_body_;
    set_keyframe(sighting);
    started_ = true;
  } else {
    auto chosen = match(sighting, expected, out);
    if (!motion_.possible(between(T_odom_body_, chosen.match.T_odom_body),
                          1e-6 * (out.utime - out.reference_utime)))
      chosen.score = 0;
    const auto& best = chosen.match;
    out.score = chosen.score;
    out.contradiction = chosen.contradiction;
    out.inlier_share = best.inlier_share;
    out.rms_residual_m = best.rms_residual_m;
    out.iterations = best.iterations;
    const bool ok = chosen.score > params_.lost_inlier_share && out.points >= params_.points_min;
    out.status = ok ? MatchStatus::kMatched : MatchStatus::kLost;
    out.T_odom_body = ok ? best.T_odom_body : expected.prior.T_odom_body;
    out.covariance = (best.information + 1e-9 * Eigen::Matrix3d::Identity()).inverse();
  }
  out.T_reference_body = between(T_odom_body_, out.T_odom_body);
  motion_.correct(scan.utime, out.T_odom_body, out.status == MatchStatus::kMatched);
  odometer_m_ += out.T_reference_body.translation().norm();
  T_odom_body_ = out.T_odom_body;
  utime_ = scan.utime;
  remember(sighting, out);
  return out;
}

void ScanMatching::remember(const Sighting& sighting, const ScanMatch& match) {
  lost_ = match.status == MatchStatus::kLost ? lost_ + 1 : 0;
  if (lost_ >= params_.lost_max) {
    reference_.clear();
    set_keyframe(sighting);
    lost_ = 0;
    return;
  }
  if (match.status != MatchStatus::kMatched) return;
  typical_ += 0.05 * (match.score - typical_);
  const Pose2 moved = between(T_odom_keyframe_, T_odom_body_);
  if (moved.translation().norm() < params_.keyframe_distance_m &&
      std::abs(moved.theta) < params_.keyframe_angle_rad)
    return;
  reference_.forget_before(odometer_m_ - params_.memory_m);
  set_keyframe(sighting);
}

void ScanMatching::set_keyframe(const Sighting& sighting) {
  reference_.insert(sighting.points, T_odom_body_, odometer_m_);
  T_odom_keyframe_ = T_odom_body_;
  keyframe_points_ = sighting.points;
  keyframe_space_ = sighting.space;
}

}  // namespace adit
