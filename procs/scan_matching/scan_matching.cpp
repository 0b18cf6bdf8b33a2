// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/scan_matching.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "procs/scan_matching/open_directions.hpp"

namespace adit {
namespace {

constexpr double kOdometerStepM = 0.1;
constexpr double kTypicalShare = 0.05;  // weight of a new score in the running mean

/// Root mean square distance of the points: how far a turn of one radian moves them.
double lever_arm_m(const std::vector<SurfacePoint>& points) {
  double squares = 0.0;
  for (const auto& point : points) squares += point.p.squaredNorm();
  return std::max(0.5, std::sqrt(squares / std::max<std::size_t>(1, points.size())));
}

}  // namespace

ScanMatching::ScanMatching(const ScanMatchingParams& params)
    : params_(params),
      motion_(params.motion),
      tilt_(params.body_tilt),
      reference_(params.reference),
      search_(params.search),
      standstill_(params.standstill) {}

bool ScanMatching::add(const ImuReading& reading) {
  tilt_.add(reading);
  return motion_.add(reading);
}

ScanMatch ScanMatching::add_scan(LaserId laser, const LaserScan& scan) {
  ScanMatch match;
  match.utime = scan.utime;
  match.reference_utime = utime_;
  if (odom_utime_ == 0) odom_utime_ = scan.utime;
  match.odom_utime = odom_utime_;
  match.T_odom_body = T_odom_body_;
  const auto last = last_scan_utime_.find(laser);
  const bool again = last != last_scan_utime_.end() && scan.utime <= last->second;
  if (again || scan.utime < utime_) return match;

  Sighting sighting = see(laser, scan);
  match.points = static_cast<std::int32_t>(sighting.points.size());
  locate(sighting, match);
  last_scan_utime_[laser] = scan.utime;
  advance(std::move(sighting), match);
  return match;
}

Sighting ScanMatching::see(LaserId laser, const LaserScan& scan) const {
  const LaserMount& mount = laser == LaserId::kFront ? params_.lasers.front : params_.lasers.rear;
  std::vector<SurfacePoint> points = surface_points(scan, mount, params_.surface);
  std::erase_if(points, [&](const SurfacePoint& point) { return !tilt_.is_level_at(point.p); });
  return {laser, std::move(points), FreeSpace(scan, mount)};
}

void ScanMatching::locate(const Sighting& sighting, ScanMatch& match) {
  const bool enough = match.points >= params_.points_min;
  const MotionEstimate expected = motion_.predict(match.utime);
  if (!reference_.knows(sighting.laser)) {
    match.status = enough ? ScanMatch::Status::kFirstScan : ScanMatch::Status::kLost;
    match.T_odom_body = expected.prior.T_odom_body;
    match.T_reference_body = between(T_odom_body_, match.T_odom_body);
    return;
  }
  PoseSearchResult found;
  if (enough) found = search_.find(sighting, reference_, expected, typical_score_);
  const PoseCandidate& best = found.best;
  match.searched = found.searched;
  match.inlier_share = best.match.inlier_share;
  match.contradiction_share = best.contradiction_share;
  match.rms_residual_m = best.match.rms_residual_m;
  match.iterations = best.match.iterations;
  if (best.score >= params_.lost_score && match.inlier_share >= params_.inlier_share_min) {
    match.status = ScanMatch::Status::kMatched;
    typical_score_ += kTypicalShare * (best.score - typical_score_);
    believe(best, expected, lever_arm_m(sighting.points), match);
  } else {
    match.status = ScanMatch::Status::kLost;
    match.T_odom_body = expected.prior.T_odom_body;
    match.covariance = (expected.prior.information + reach_information(expected)).inverse();
    reference_covariance_.setZero();
  }
  standstill_.hold(expected, match);
  match.T_reference_body = between(T_odom_body_, match.T_odom_body);
}

void ScanMatching::believe(const PoseCandidate& best, const MotionEstimate& expected,
                           double lever_arm, ScanMatch& match) {
  const auto known =
      split_degenerate(best.match.information, best.match.spurious, lever_arm, params_.degeneracy);
  match.lever_arm_m = lever_arm;
  for (const OpenDirection& open : known.degenerate) {
    match.degenerate.push_back({open.direction, fill_of(open.direction, expected)});
  }
  match.T_odom_body = fill_open(best.match.T_odom_body, expected, known.degenerate, lever_arm);
  // Both ends of the motion were found against the reference, each with its own error.
  const Eigen::Matrix3d Ad = adjoint(between(match.T_odom_body, T_odom_body_));
  match.covariance =
      (known.information + expected.prior.information + reach_information(expected)).inverse() +
      Ad * reference_covariance_ * Ad.transpose();
  reference_covariance_ = known.covariance;
}

void ScanMatching::advance(Sighting sighting, const ScanMatch& match) {
  const bool lost = match.status == ScanMatch::Status::kLost;
  motion_.correct(match.utime, match.T_odom_body, !lost && !leaves_open(match));
  T_odom_body_ = match.T_odom_body;
  utime_ = match.utime;
  count_way();
  learn(std::move(sighting), match);
}

/// In steps that stand out from the noise: the sum of what two lasers disagree about, 75 times a
/// second, would let a robot that stands still forget the walls around it.
void ScanMatching::count_way() {
  const double step_m = between(T_odom_counted_, T_odom_body_).translation().norm();
  if (step_m < kOdometerStepM) return;
  odometer_m_ += step_m;
  tilt_.drive(step_m);
  T_odom_counted_ = T_odom_body_;
}

void ScanMatching::learn(Sighting sighting, const ScanMatch& match) {
  if (match.status != ScanMatch::Status::kLost) {
    lost_in_a_row_ = 0;
    lost_in_a_row_of_[sighting.laser] = 0;
    reference_.remember(std::move(sighting), T_odom_body_, odometer_m_);
    return;
  }
  int& of_laser = lost_in_a_row_of_[sighting.laser];
  ++lost_in_a_row_;
  ++of_laser;
  if (match.points < params_.points_min) return;
  if (lost_in_a_row_ >= params_.lost_max) {
    reference_.restart(std::move(sighting), T_odom_body_, odometer_m_);
    lost_in_a_row_ = 0;
    lost_in_a_row_of_.clear();
  } else if (of_laser >= params_.lost_max) {  // the others know where the body is
    reference_.begin_anew(std::move(sighting), T_odom_body_, odometer_m_);
    of_laser = 0;
  }
}

}  // namespace adit
