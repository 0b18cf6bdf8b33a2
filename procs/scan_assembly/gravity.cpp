// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/gravity.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace adit {
namespace {

constexpr double kGravity = 9.81;  // [m/s²]

}  // namespace

bool GravityEstimator::add(const ImuReading& reading) {
  if (!reading.linear_acceleration.allFinite()) return false;
  forces_.push_back(reading.linear_acceleration);
  if (forces_.size() > static_cast<std::size_t>(params_.readings)) forces_.pop_front();
  return true;
}

std::optional<Eigen::Vector3d> GravityEstimator::up_body() const {
  if (!has_all_readings()) return std::nullopt;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& force : forces_) sum += force;
  const Eigen::Vector3d mean = sum / static_cast<double>(forces_.size());
  if (std::abs(mean.norm() - kGravity) > params_.deviation_max_m_s2) return std::nullopt;
  return mean.normalized();
}

Eigen::Matrix3d level_rotation(const Eigen::Vector3d& up_body) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  Eigen::Matrix3d R;
  R.row(2) = up_body;
  R.row(0) = (forward - forward.dot(up_body) * up_body).normalized();
  R.row(1) = Eigen::Vector3d(R.row(2)).cross(Eigen::Vector3d(R.row(0)));
  return R;
}

}  // namespace adit
