// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/ground/ground_attitude.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "common/geometry/symmetric_solve.hpp"
#include "common/grid/grid2.hpp"

namespace adit {
namespace {

constexpr double kCellM = 0.1;
constexpr int kWheelCells = 1;          // the ground under a wheel is the mean of the cells around
constexpr float kPassableM = 0.3F;      // what is higher is no ground
constexpr double kGroundRangeM = 12.0;  // farther ground is too uncertain
constexpr double kPlaneSd = 0.05;       // of the slope of the first plane
constexpr double kPlanSdM = 0.1;        // of the planar motion between two scans
constexpr double kHeadingSd = 0.02;
constexpr double kGateM = 0.3;  // the ground of another level is farther away

// A terrain map is moved onto remembered ground.
constexpr double kMatchedSdM = 0.03;  // of a 3D scan that was matched to the one before
constexpr double kMatchedSd = 0.01;
constexpr double kCellVariance = 0.03 * 0.03;
constexpr double kCellsPerMeasurement = 25.0;  // neighbouring cells have common errors
constexpr double kKernelM = 0.1;
constexpr int kIterations = 3;

std::uint64_t ground_cell_key(const Eigen::Vector2i& cell) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.y())) << 32U) |
         static_cast<std::uint32_t>(cell.x());
}

/// The ground of a terrain map near its scan: points in level.
std::vector<Eigen::Vector3d> ground_points(const TerrainMap& terrain) {
  std::vector<Eigen::Vector3d> points;
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      const TerrainCell& cell = terrain.cells.at({column, row});
      if (cell.ground != Ground::kObserved || !std::isfinite(cell.low_m)) continue;
      if (!(cell.coefficient_m < kPassableM)) continue;
      const Eigen::Vector2d p = terrain.centre(column, row);
      if (p.norm() > kGroundRangeM) continue;
      points.emplace_back(p.x(), p.y(), static_cast<double>(cell.low_m));
    }
  }
  return points;
}

Eigen::Vector2d slope_of(const Eigen::Vector3d& up) { return up.head<2>() / up.z(); }

}  // namespace

void GroundAttitude::clear() {
  plane_.reset();
  last_.reset();
  ground_m_.clear();
}

void GroundAttitude::add(const Cloud& cloud, double z_odom_m) {
  PlacedCloud placed{RegistrationCloud(cloud, params_.registration), cloud.utime,
                     cloud.T_odom_level, z_odom_m, Eigen::Vector3d::UnitZ()};
  if (!plane_) plane_ = Plane{};
  if (last_) match(placed);
  // The frame level has the tilt that the body was taken to have less that of the match.
  plane_->T_odom_body = cloud.T_odom_level;
  plane_->state[0] = placed.z_odom_m;
  plane_->state.tail<2>() +=
      Eigen::Rotation2Dd(cloud.T_odom_level.theta) * slope_of(placed.up_level);
  plane_->covariance =
      Eigen::Vector3d(params_.wheel_sd_m, kPlaneSd, kPlaneSd).cwiseAbs2().asDiagonal();
  last_ = std::move(placed);
}

/// Sets height and tilt of a scan from its match to the last one.
void GroundAttitude::match(PlacedCloud& cloud) const {
  const Pose2 T_last_cloud = between(last_->T_odom_level, cloud.T_odom_level);
  CloudPrior prior;
  prior.T_target_source = in_space(T_last_cloud, cloud.z_odom_m - last_->z_odom_m);
  // By the estimate the scan is level, and the last one has its own tilt.
  prior.T_target_source.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), last_->up_level)
          .toRotationMatrix() *
      Eigen::AngleAxisd(T_last_cloud.theta, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  prior.T_target_source.translation().z() -=
      slope_of(last_->up_level).dot(T_last_cloud.translation());
  Vector6d sd;
  sd << kPlanSdM, kPlanSdM, params_.height_sd_m, params_.level_sd_rad, params_.level_sd_rad,
      kHeadingSd;
  prior.information = sd.cwiseAbs2().cwiseInverse().asDiagonal();
  const CloudRegistration matched =
      register_clouds(cloud.surfaces, last_->surfaces, prior, params_.registration);
  if (!matched.accepted) return;
  cloud.up_level = matched.T_target_source.linear().transpose() * last_->up_level;
  cloud.z_odom_m = last_->z_odom_m + last_->up_level.dot(matched.T_target_source.translation());
}

GroundAttitude::Level GroundAttitude::add(const TerrainMap& terrain, double z_odom_m) {
  Level level{z_odom_m, Eigen::Vector2d::Zero()};
  if (last_ && last_->utime == terrain.utime) {
    level = {last_->z_odom_m, slope_of(last_->up_level)};
  }
  if (!plane_) return level;
  const std::vector<Eigen::Vector3d> points = ground_points(terrain);
  if (last_ && last_->utime == terrain.utime) {
    const Eigen::Vector3d correction = to_remembered(points, terrain.T_odom_level, level);
    level.z_odom_m += correction[0];
    level.slope += correction.tail<2>();
    last_->z_odom_m = level.z_odom_m;
    last_->up_level = Eigen::Vector3d(level.slope.x(), level.slope.y(), 1.0).normalized();
    plane_->state[0] = level.z_odom_m;
    plane_->state.tail<2>() +=
        Eigen::Rotation2Dd(terrain.T_odom_level.theta) * Eigen::Vector2d(correction.tail<2>());
  }
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2i cell =
        cell_of(terrain.T_odom_level * Eigen::Vector2d(p.head<2>()), kCellM);
    ground_m_[ground_cell_key(cell)] =
        static_cast<float>(level.z_odom_m + p.z() + level.slope.dot(p.head<2>()));
  }
  return level;
}

/// Height and slope that move a terrain map onto the ground that earlier ones showed, with what the
/// match of the 3D scans left uncertain as their prior: least squares with a robust kernel.
Eigen::Vector3d GroundAttitude::to_remembered(const std::vector<Eigen::Vector3d>& points,
                                              const Pose2& T_odom_level, const Level& level) const {
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();
  const Eigen::Matrix3d prior =
      Eigen::Vector3d(kMatchedSdM, kMatchedSd, kMatchedSd).cwiseAbs2().cwiseInverse().asDiagonal();
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix3d A = prior;
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) {
      const auto found = ground_m_.find(
          ground_cell_key(cell_of(T_odom_level * Eigen::Vector2d(p.head<2>()), kCellM)));
      if (found == ground_m_.end()) continue;
      const double z_m = level.z_odom_m + p.z() + level.slope.dot(p.head<2>());
      const double higher_m = static_cast<double>(found->second) - z_m;
      const Eigen::Vector3d J(1.0, p.x(), p.y());
      const double residual_m = higher_m - J.dot(correction);
      const double kernel = kKernelM * kKernelM / (kKernelM * kKernelM + residual_m * residual_m);
      const double weight = kernel * kernel / (kCellVariance * kCellsPerMeasurement);
      A += weight * J * J.transpose();
      b += weight * higher_m * J;
    }
    correction = solve_symmetric(A, b);
  }
  return correction;
}

void GroundAttitude::drive(const Pose2& T_odom_body) {
  if (!plane_) return;
  Eigen::Vector3d& x = plane_->state;
  Eigen::Matrix3d& P = plane_->covariance;
  const Eigen::Vector2d step = T_odom_body.translation() - plane_->T_odom_body.translation();
  plane_->T_odom_body = T_odom_body;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F.block<1, 2>(0, 1) = step.transpose();
  x = F * x;
  const double slope_variance = params_.slope_sd_per_m * params_.slope_sd_per_m * step.norm();
  P = F * P * F.transpose();
  P.diagonal() +=
      Eigen::Vector3d(slope_variance * step.squaredNorm(), slope_variance, slope_variance);
  const Attitude attitude = *this->attitude(T_odom_body.theta);
  for (const double along : {0.5, -0.5}) {
    for (const double across : {0.5, -0.5}) {
      const Eigen::Vector2d wheel(along * vehicle_.wheelbase_m * std::cos(attitude.pitch_rad),
                                  across * vehicle_.track_m * std::cos(attitude.roll_rad));
      const Eigen::Vector2d p_odom = T_odom_body * wheel;
      const auto ground = ground_m(p_odom);
      if (!ground) continue;
      Eigen::Vector3d H;
      H << 1.0, p_odom - T_odom_body.translation();
      const double innovation_m = *ground - H.dot(x);
      if (std::abs(innovation_m) > kGateM) continue;
      const Eigen::Vector3d PH = P * H;
      const double variance = H.dot(PH) + params_.wheel_sd_m * params_.wheel_sd_m;
      x += PH * innovation_m / variance;
      P -= PH * PH.transpose() / variance;
    }
  }
}

std::optional<double> GroundAttitude::ground_m(const Eigen::Vector2d& p_odom) const {
  const Eigen::Vector2i cell = cell_of(p_odom, kCellM);
  double sum = 0.0;
  int count = 0;
  for (int x = -kWheelCells; x <= kWheelCells; ++x) {
    for (int y = -kWheelCells; y <= kWheelCells; ++y) {
      const auto found = ground_m_.find(ground_cell_key(cell + Eigen::Vector2i(x, y)));
      if (found == ground_m_.end()) continue;
      sum += static_cast<double>(found->second);
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::optional<Attitude> GroundAttitude::attitude(double heading_rad) const {
  if (!plane_) return std::nullopt;
  const Eigen::Vector2d slope =
      Eigen::Rotation2Dd(-heading_rad) * Eigen::Vector2d(plane_->state.tail<2>());
  // The vertical in the frame of the ground: x ahead and up the slope.
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  const Eigen::Vector3d ahead = Eigen::Vector3d(1.0, 0.0, slope.x()).normalized();
  return Attitude::from_up({ahead.z(), normal.cross(ahead).z(), normal.z()});
}

std::optional<double> GroundAttitude::z_odom_m() const {
  if (!plane_) return std::nullopt;
  return plane_->state[0];
}

}  // namespace adit
