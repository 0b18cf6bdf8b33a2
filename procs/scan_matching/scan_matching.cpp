// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/scan_matching.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/geometry/pose2.hpp"
#include "common/registration/degeneracy.hpp"
#include "common/sensing/motion_correction.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/sensing/seconds.hpp"
#include "procs/scan_matching/motion/motion_prediction.hpp"

namespace adit {
namespace {

constexpr std::int64_t kRestartUs = 3'000'000;  // SensorClocks follows a clock after 2 s
constexpr double kSpeedSdM = 0.2;               // deviation from the last speed in one step
constexpr double kSpeedSdRad = 0.2;

/// Information of the prediction along a direction: that of the sensors, plus that of a constant
/// speed.
double expected_information(const Eigen::Vector3d& direction, const MotionEstimate& expected,
                            double lever_arm) {
  const Eigen::Vector3d to_radians(1.0, 1.0, 1.0 / lever_arm);
  const Eigen::Vector3d v = direction.cwiseProduct(to_radians);
  const Eigen::Vector3d variances(kSpeedSdM * kSpeedSdM, kSpeedSdM * kSpeedSdM,
                                  kSpeedSdRad * kSpeedSdRad);
  return v.dot(expected.prior.information * v) + v.dot(v.cwiseQuotient(variances));
}

/// What replaces the scan along `direction`, (x, y, θ) in the body frame with θ scaled by the lever
/// arm.
DegenerateDirection::Fill fill_of(const Eigen::Vector3d& direction,
                                  const MotionEstimate& expected) {
  const bool mostly_turn = std::abs(direction.z()) > 0.7;
  if (expected.from_gyro && mostly_turn) return DegenerateDirection::Fill::kImu;
  if (expected.from_odometry) return DegenerateDirection::Fill::kOdometry;
  return DegenerateDirection::Fill::kNone;
}

/// Information from the bounds of motion alone: of (x, y, θ) in the body frame.
Eigen::Matrix3d motion_bound_information(const MotionEstimate& expected) {
  const double m = std::max(expected.displacement_max_m, 1e-3);
  const double rad = std::max(expected.turn_max_rad, 1e-3);
  return Eigen::Vector3d(1.0 / (m * m), 1.0 / (m * m), 1.0 / (rad * rad)).asDiagonal();
}

/// Moves the pose towards the prediction along the directions that the match does not constrain, in
/// proportion to the information of prediction and match.
Pose2 fill_unconstrained(const Pose2& T_odom_body, const MotionEstimate& expected,
                         const std::vector<UnconstrainedDirection>& directions, double lever_arm) {
  const Eigen::Vector3d scale(1.0, 1.0, lever_arm);
  const Eigen::Vector3d off =
      between(T_odom_body, expected.prior.T_odom_body).vector().cwiseProduct(scale);
  Eigen::Vector3d back = Eigen::Vector3d::Zero();
  for (const auto& [v, information] : directions) {
    const double prior = expected_information(v, expected, lever_arm);
    back += v * v.dot(off) * prior / (prior + information);
  }
  return T_odom_body * Pose2::from_vector(back.cwiseQuotient(scale));
}

constexpr double kUnknownPitchSd = 0.05;
constexpr double kGroundPitchSd = 0.02;  // of the ground that 3D scans showed
constexpr double kBridgedM = 0.1;        // motion between two scans that measure it
constexpr double kOdometerStepM = 0.1;
constexpr double kTypicalShare = 0.05;  // weight of a new score in the running mean

/// The group of surfaces ahead or behind that may be rising ground, or the roof over falling
/// ground: not walls along the direction of travel, and not so near that no vehicle could climb
/// them.
std::optional<int> grade_group_of(const SurfacePoint& point, double laser_m) {
  constexpr double kAlongMax = 0.5;  // sine of 30°
  constexpr double kGradeMax = 0.35;
  const bool along = point.has_normal() && std::abs(point.normal.x()) <= kAlongMax;
  if (along || std::abs(point.p.x()) < laser_m / kGradeMax) return std::nullopt;
  return point.p.x() > 0.0 ? 0 : 1;
}

/// Whether two neighbouring points lie on one surface.
bool are_of_one_surface(const SurfacePoint& a, const SurfacePoint& b) {
  constexpr double kApartM = 0.5;
  constexpr double kNormalCosine = 0.87;  // of 30°
  return (a.p - b.p).norm() < kApartM && a.normal.dot(b.normal) > kNormalCosine;
}

/// Of the points that may be ground or roof, `groups` by point, those that are not known to be
/// wall. A surface is one or the other: where it meets a side wall the terrain shows an obstacle,
/// which is that wall, and a few points of ground that count as wall take the pose along as the
/// body pitches.
void set_grade_groups(std::vector<SurfacePoint>& points,
                      const std::vector<std::optional<int>>& groups,
                      const std::vector<bool>& is_unknown) {
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    auto unknown = static_cast<std::size_t>(is_unknown[begin] ? 1 : 0);
    while (end < points.size() && groups[begin] && groups[end] == groups[begin] &&
           are_of_one_surface(points[end - 1], points[end])) {
      unknown += is_unknown[end] ? 1 : 0;
      ++end;
    }
    const bool mostly_unknown = 2 * unknown > end - begin;
    for (; begin < end; ++begin) {
      if (mostly_unknown || is_unknown[begin]) points[begin].grade_group = groups[begin];
    }
  }
}

/// The measured beams that these beams show, each once, in order.
std::vector<std::int32_t> measured_beams(const StillScan& still, std::vector<std::int32_t> beams) {
  if (still.beam_of.empty()) return beams;
  for (std::int32_t& beam : beams) beam = still.measured_beam(beam);
  std::ranges::sort(beams);
  beams.erase(std::unique(beams.begin(), beams.end()), beams.end());
  return beams;
}

/// Root mean square distance of the points: the mean displacement per radian of turn.
double lever_arm_m(const std::vector<SurfacePoint>& points) {
  double squares = 0.0;
  for (const auto& point : points) squares += point.p.squaredNorm();
  return std::max(0.5, std::sqrt(squares / std::max<std::size_t>(1, points.size())));
}

}  // namespace

ScanMatching::ScanMatching(const ScanMatchingParams& params)
    : params_(params),
      motion_(params.motion),
      wheel_scale_(params.wheel_scale),
      attitude_(params.attitude),
      ground_attitude_(params.ground_attitude, params.vehicle),
      reference_(params.reference),
      disagreement_(params.disagreement),
      search_(params.search),
      standstill_(params.standstill),
      chain_doubt_(params.doubt) {}

bool ScanMatching::add(const WheelOdometry& reading) {
  if (!motion_.add(reading)) return false;
  attitude_.add(reading);
  return true;
}

bool ScanMatching::add(const ImuReading& reading) {
  attitude_.add(reading);
  return motion_.add(reading, attitude_.attitude().value_or(Attitude{}));
}

void ScanMatching::add(const Cloud& cloud) {
  if (attitude_.attitude()) {
    ground_attitude_.clear();
    return;
  }
  ground_attitude_.add(cloud, z_m_);
  z_m_ = ground_attitude_.z_odom_m().value_or(z_m_);
}

void ScanMatching::add(TerrainMap terrain) {
  // The robot stands from the end of the sweep until the map is used.
  const GroundAttitude::Level level = ground_attitude_.add(terrain, z_m_);
  if (!attitude_.attitude()) z_m_ = ground_attitude_.z_odom_m().value_or(z_m_);
  ground_.add(std::move(terrain), level.z_odom_m, level.slope);
}

/// Against gravity by the IMU; without one by the ground that 3D scans showed.
std::optional<Attitude> ScanMatching::attitude() const {
  if (const auto measured = attitude_.attitude()) return measured;
  return ground_attitude_.attitude(T_odom_body_.theta);
}

ScanMatch ScanMatching::add_scan(LaserId laser, const LaserScan& scan) {
  if (odom_epoch_utime_ == 0) odom_epoch_utime_ = scan.utime;
  if (time_restarts_) shift_time_to(scan.utime);
  ScanMatch match = rejected(scan.utime);
  doubt_.reset();
  if (!advances_in_time(laser, scan.utime)) return match;

  const double level_share = match.attitude ? std::cos(match.attitude->pitch_rad) : 1.0;
  const MotionEstimate expected = motion_.predict(scan.utime, level_share * wheel_scale_.scale());
  const StillScan still = without_motion(scan, mount_of(laser), velocity(scan.utime, expected));
  ScanObservation observation = observe(laser, still.scan, expected.prior.T_odom_body);
  match.points = static_cast<std::int32_t>(observation.points.size());
  match.ground_beams = measured_beams(still, std::move(observation.ground_beams));
  PoseSearchResult found;
  const bool has_reference = reference_.has_laser(laser);
  if (has_reference) {
    found = locate(observation, expected, match);  // Lu and Milios 1997; Censi 2008; Olson 2009
    standstill_.apply(laser, expected, match);
  } else {
    const bool enough = match.points >= params_.points_min;
    match.status = enough ? ScanMatch::Status::kFirstScan : ScanMatch::Status::kLost;
    match.T_odom_body = expected.prior.T_odom_body;
  }
  match.unconfirmed_beams =
      measured_beams(still, unconfirmed_beams(observation, match.T_odom_body));
  match.T_reference_body = between(T_odom_body_, match.T_odom_body);
  match.z_m += climb_m(match);
  compare_with_wheels(match, expected, level_share);
  match.wheels_scale_sd = expected.from_odometry ? wheel_scale_.sd() : 0.0;
  if (has_reference) doubt_ = chain_doubt_.judge(match, expected, found);
  last_scan_utime_[laser] = scan.utime;
  advance(std::move(observation), match);
  return match;
}

void ScanMatching::restart_time() {
  if (utime_ == 0) return;
  time_restarts_ = true;
  last_scan_utime_.clear();
  motion_.clear_readings();
  attitude_ = BodyAttitude(params_.attitude);
  disagreement_ = LaserDisagreement(params_.disagreement);
}

void ScanMatching::shift_time_to(std::int64_t utime) {
  time_restarts_ = false;
  const std::int64_t shift_us = utime - kRestartUs - utime_;
  utime_ += shift_us;
  motion_.shift_time(shift_us);
  chain_doubt_.shift_time(shift_us);
}

const LaserMount& ScanMatching::mount_of(LaserId laser) const {
  return laser == LaserId::kFront ? params_.lasers.front : params_.lasers.rear;
}

/// Of (x, y, θ) in the body frame, by the expected motion since the last scan.
Eigen::Vector3d ScanMatching::velocity(std::int64_t utime, const MotionEstimate& expected) const {
  const double duration_s = seconds(utime - utime_);
  if (utime_ == 0 || !(duration_s > 0.0)) return Eigen::Vector3d::Zero();
  return between(T_odom_body_, expected.prior.T_odom_body).vector() / duration_s;
}

/// The result for a scan that is not used: the last pose.
ScanMatch ScanMatching::rejected(std::int64_t utime) const {
  ScanMatch match;
  match.utime = utime;
  match.reference_utime = utime_;
  match.odom_epoch_utime = odom_epoch_utime_;
  match.T_odom_body = T_odom_body_;
  match.attitude = attitude();
  match.attitude_from_ground = match.attitude && !attitude_.attitude();
  match.z_m = z_m_;
  return match;
}

/// Of the surfaces that may be ground or roof: what the reference shows at different heights needs
/// no 3D scan to be a wall.
std::vector<std::int32_t> ScanMatching::unconfirmed_beams(const ScanObservation& observation,
                                                          const Pose2& T_odom_body) const {
  std::vector<std::int32_t> beams;
  const bool has_reference = reference_.has_laser(observation.laser);
  for (const SurfacePoint& point : observation.points) {
    if (!point.grade_group) continue;
    if (has_reference && reference_.is_steep_at(point, T_odom_body)) continue;
    beams.push_back(point.beam);
  }
  return beams;
}

/// The body moves along the plane on which it stands.
double ScanMatching::climb_m(const ScanMatch& match) const {
  if (!match.attitude) return 0.0;
  const Eigen::Vector2d step =
      Eigen::Rotation2Dd(-match.T_reference_body.theta) * match.T_reference_body.translation();
  return ground_slope(*match.attitude).dot(step);
}

/// Between two scans that constrain the pose in all directions, the motion along the body is
/// measured by scans, also if one of another laser in between does not.
void ScanMatching::compare_with_wheels(const ScanMatch& match, const MotionEstimate& expected,
                                       double level_share) {
  if (!expected.from_odometry) {
    T_odom_measured_.reset();
    return;
  }
  wheels_since_measured_ = wheels_since_measured_ * expected.wheels_step;
  const bool measured = match.status == ScanMatch::Status::kMatched && match.degenerate.empty();
  const bool bridged = wheels_since_measured_.translation().norm() <= kBridgedM;
  if (!measured && bridged) return;
  const bool compared = measured && bridged && T_odom_measured_;
  wheel_scale_.add(
      wheels_since_measured_, level_share,
      compared ? std::optional(between(*T_odom_measured_, match.T_odom_body)) : std::nullopt);
  T_odom_measured_ = measured ? std::optional(match.T_odom_body) : std::nullopt;
  wheels_since_measured_ = {};
}

bool ScanMatching::advances_in_time(LaserId laser, std::int64_t utime) const {
  const auto last = last_scan_utime_.find(laser);
  const bool repeated = last != last_scan_utime_.end() && utime <= last->second;
  return !repeated && utime >= utime_;
}

/// Points on the ground and the roof are left out: they move with the attitude of the body.
ScanObservation ScanMatching::observe(LaserId laser, const LaserScan& scan,
                                      const Pose2& T_odom_expected) const {
  const LaserMount& mount = mount_of(laser);
  const std::optional<Attitude> known = this->attitude();
  const Attitude attitude = known.value_or(Attitude{});
  std::vector<SurfacePoint> points = surface_points(scan, mount, params_.surface, attitude);
  std::vector<SurfacePoint> walls;
  walls.reserve(points.size());
  std::vector<std::int32_t> ground_beams;
  std::vector<std::optional<int>> groups;
  std::vector<bool> unknown;
  // Without an IMU ground is taken for level until a 3D scan shows that it is not.
  const bool ground_may_slope = attitude_.attitude() || ground_.shows_slope();
  for (SurfacePoint& point : points) {
    using Surface = KnownGround::Surface;
    const Surface surface =
        ground_.surface_at(T_odom_expected * point.p, z_m_ + point.z_m, point.p.norm());
    const bool is_unknown = surface == Surface::kUnknown;
    if (surface != Surface::kWall &&
        !(is_unknown && attitude_.is_level_at(point, mount.height_m))) {
      ground_beams.push_back(point.beam);
      continue;
    }
    groups.push_back(ground_may_slope ? grade_group_of(point, mount.height_m) : std::nullopt);
    unknown.push_back(is_unknown);
    if (!attitude_.attitude()) point.pitch_sd_rad = known ? kGroundPitchSd : kUnknownPitchSd;
    point.z_m += z_m_;
    walls.push_back(point);
  }
  set_grade_groups(walls, groups, unknown);
  return {laser, std::move(walls), FreeSpace(scan, mount, attitude, z_m_), std::move(ground_beams)};
}

/// Matches the scan against the reference. Without an accepted match the pose is the prediction.
PoseSearchResult ScanMatching::locate(const ScanObservation& observation,
                                      const MotionEstimate& expected, ScanMatch& match) {
  PoseSearchResult found;
  if (match.points >= params_.points_min) {
    found = search_.find(observation, reference_, expected, typical_score_);
  }
  const PoseCandidate& best = found.best;
  match.searched = found.searched;
  match.inlier_share = best.match.inlier_share;
  match.contradiction_share = best.contradiction_share;
  match.rms_residual_m = best.match.rms_residual_m;
  match.iterations = best.match.iterations;
  if (best.score >= params_.lost_score && match.inlier_share >= params_.inlier_share_min) {
    match.status = ScanMatch::Status::kMatched;
    typical_score_ += kTypicalShare * (best.score - typical_score_);
    accept_match(observation.laser, best, expected, lever_arm_m(observation.points), match);
  } else {
    match.status = ScanMatch::Status::kLost;
    match.T_odom_body = expected.prior.T_odom_body;
    match.covariance = (expected.prior.information + motion_bound_information(expected)).inverse();
    reference_covariance_.setZero();
  }
  return found;
}

/// Sets pose and covariance from the match, and from the prediction in degenerate directions.
void ScanMatching::accept_match(LaserId laser, const PoseCandidate& best,
                                const MotionEstimate& expected, double lever_arm,
                                ScanMatch& match) {
  ConstrainedInformation constrained =
      split_degenerate(best.match.information, best.match.spurious, lever_arm, params_.degeneracy);
  match.lever_arm_m = lever_arm;
  for (const UnconstrainedDirection& unconstrained : constrained.degenerate) {
    match.degenerate.push_back(
        {unconstrained.direction, fill_of(unconstrained.direction, expected)});
  }
  match.T_odom_body = disagreement_.fuse(
      laser, match.utime, expected,
      fill_unconstrained(best.match.T_odom_body, expected, constrained.degenerate, lever_arm),
      constrained.information);
  // Both ends of the motion were matched against the reference, each with its own error.
  const Eigen::Matrix3d Ad = adjoint(between(match.T_odom_body, T_odom_body_));
  match.covariance =
      (constrained.information + expected.prior.information + motion_bound_information(expected))
          .inverse() +
      Ad * reference_covariance_ * Ad.transpose();
  reference_covariance_ = constrained.covariance;
}

/// Corrects the motion prediction and updates the reference.
void ScanMatching::advance(ScanObservation observation, const ScanMatch& match) {
  const bool lost = match.status == ScanMatch::Status::kLost;
  motion_.correct(match.utime, match.T_odom_body, !lost && !has_unobserved_direction(match), !lost);
  T_odom_body_ = match.T_odom_body;
  z_m_ = match.z_m;
  utime_ = match.utime;
  attitude_.add(utime_, T_odom_body_);
  update_odometer();
  update_reference(std::move(observation), match);
}

/// Counts only steps above the noise: the sum of the disagreement of two lasers, 75 times a second,
/// would make a standing robot forget the walls around it.
void ScanMatching::update_odometer() {
  const double step_m = between(T_odom_counted_, T_odom_body_).translation().norm();
  if (step_m < kOdometerStepM) return;
  odometer_m_ += step_m;
  attitude_.drive(step_m);
  T_odom_counted_ = T_odom_body_;
  if (!attitude_.attitude()) {
    ground_attitude_.drive(T_odom_body_);
    z_m_ = ground_attitude_.z_odom_m().value_or(z_m_);
  }
  if (attitude()) ground_.add(T_odom_body_.translation(), z_m_);
}

void ScanMatching::update_reference(ScanObservation observation, const ScanMatch& match) {
  if (match.status != ScanMatch::Status::kLost) {
    lost_in_a_row_ = 0;
    lost_in_a_row_of_[observation.laser] = 0;
    // Drawn where nothing tells the place along some direction, what may be ground would hold the
    // body there as soon as it is known to be a wall.
    reference_.add_keyframe(std::move(observation), T_odom_body_, odometer_m_,
                            !match.degenerate.empty());
    return;
  }
  int& of_laser = lost_in_a_row_of_[observation.laser];
  ++lost_in_a_row_;
  ++of_laser;
  if (match.points < params_.points_min) return;
  if (lost_in_a_row_ >= params_.lost_max) {
    reference_.reset(std::move(observation), T_odom_body_, odometer_m_);
    lost_in_a_row_ = 0;
    lost_in_a_row_of_.clear();
  } else if (of_laser >= params_.lost_max) {  // the other lasers still determine the pose
    reference_.reset_laser(std::move(observation), T_odom_body_, odometer_m_);
    of_laser = 0;
  }
}

}  // namespace adit
