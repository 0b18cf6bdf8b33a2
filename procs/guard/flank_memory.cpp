// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/flank_memory.hpp"

#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "common/types/body_outline.hpp"

namespace adit {
namespace {

constexpr double kCellM = 0.04;
constexpr double kBesideM = 1.0;     // maximum distance from the flank
constexpr double kViewEdgeM = 0.15;  // ahead of a laser; more than the vehicle drives between scans
constexpr double kNeighboursM = 0.1;  // maximum distance; a single beam does not count
constexpr double kJumpM = 0.5;        // maximum step between poses
constexpr double kBehindM = 3.0;      // behind a vehicle that is blind there
constexpr double kSurfaceM = 0.03;    // between points of neighbouring beams on one surface

bool are_neighbours(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - b).norm() <= kNeighboursM;  // false for NaN
}

/// The mean of a point and those of the beams beside it, if all three are on one surface: a stored
/// point counts alone and for long, and the farthest of many errors would count.
Eigen::Vector2d smoothed(const std::vector<Eigen::Vector2d>& p_body, std::size_t i) {
  if (i == 0 || i + 1 >= p_body.size()) return p_body[i];
  const Eigen::Vector2d& before = p_body[i - 1];
  const Eigen::Vector2d& after = p_body[i + 1];
  const bool on_one_surface =
      (p_body[i] - before).norm() <= kSurfaceM && (after - p_body[i]).norm() <= kSurfaceM;
  return on_one_surface ? Eigen::Vector2d((before + p_body[i] + after) / 3.0) : p_body[i];
}

std::pair<double, double> cell_of(const Eigen::Vector2d& p_odom) {
  return {std::floor(p_odom.x() / kCellM), std::floor(p_odom.y() / kCellM)};
}

/// The pose as a matrix: sine and cosine are computed once for all points.
Eigen::Isometry2d in_plane(const Pose2& T_a_b) {
  return Eigen::Translation2d(T_a_b.translation()) * Eigen::Rotation2Dd(T_a_b.theta);
}

}  // namespace

FlankMemory::FlankMemory(const Vehicle& vehicle, const Lasers& lasers)
    : outline_(body_outline(vehicle)),
      front_x_m_(lasers.front.T_body_laser.x),
      rear_x_m_(lasers.has_rear() ? lasers.rear.T_body_laser.x
                                  : -0.5 * vehicle.length_m - kBehindM),
      has_rear_(lasers.has_rear()),
      range_min_m_(lasers.front.range_min_m) {
  if (lasers.lidar.present) p_body_lidar_ = lasers.front.T_body_laser.translation();
}

void FlankMemory::move_to(const Pose2& T_odom_body) {
  if (T_odom_body_ && between(*T_odom_body_, T_odom_body).translation().norm() > kJumpM) {
    p_odom_.clear();
  }
  T_odom_body_ = T_odom_body;
  update_points();
}

void FlankMemory::observe(LaserId laser, const LaserPoints& points) {
  if (!T_odom_body_) return;
  const Eigen::Isometry2d T_odom_body = in_plane(*T_odom_body_);
  const Eigen::Isometry2d T_body_odom = T_odom_body.inverse();
  std::erase_if(p_odom_, [&](const auto& stored) {
    return is_in_view_of(laser, T_body_odom * stored.second);
  });
  for (std::size_t i = 1; i < points.p_body.size(); ++i) {
    const Eigen::Vector2d& p = points.p_body[i];
    if (!is_at_view_edge(laser, p) || !are_neighbours(p, points.p_body[i - 1])) continue;
    const Eigen::Vector2d p_odom = T_odom_body * smoothed(points.p_body, i);
    p_odom_.emplace(cell_of(p_odom), p_odom);
  }
  update_points();
}

bool FlankMemory::is_in_view_of(LaserId laser, const Eigen::Vector2d& p_body) const {
  if (laser == LaserId::kRear) return has_rear_ && p_body.x() <= rear_x_m_;
  if (p_body_lidar_) return from_lidar_m(p_body) >= range_min_m_;
  return p_body.x() >= front_x_m_;
}

bool FlankMemory::is_at_view_edge(LaserId laser, const Eigen::Vector2d& p_body) const {
  if (p_body_lidar_) {
    const double beyond_m = from_lidar_m(p_body) - range_min_m_;
    return beyond_m >= 0.0 && beyond_m <= kViewEdgeM;
  }
  const double ahead_m =
      laser == LaserId::kFront ? p_body.x() - front_x_m_ : rear_x_m_ - p_body.x();
  return ahead_m >= 0.0 && ahead_m <= kViewEdgeM &&
         std::abs(p_body.y()) <= outline_.high().y() + kBesideM;
}

bool FlankMemory::is_beside(const Eigen::Vector2d& p_body) const {
  const double beside_m = std::abs(p_body.y()) - outline_.high().y();
  const bool in_footprint = outline_.contains(p_body);
  if (p_body_lidar_) return !in_footprint && from_lidar_m(p_body) <= range_min_m_ + kViewEdgeM;
  return !in_footprint && beside_m <= kBesideM && p_body.x() <= front_x_m_ + kViewEdgeM &&
         p_body.x() >= rear_x_m_ - kViewEdgeM;
}

/// Points that are still in view are stored, but only the laser counts for them.
void FlankMemory::update_points() {
  const Eigen::Isometry2d T_body_odom = in_plane(T_odom_body_->inverse());
  p_body_.clear();
  std::erase_if(p_odom_,
                [&](const auto& stored) { return !is_beside(T_body_odom * stored.second); });
  for (const auto& [cell, p_odom] : p_odom_) {
    const Eigen::Vector2d p = T_body_odom * p_odom;
    const bool in_view = is_in_view_of(LaserId::kFront, p) || is_in_view_of(LaserId::kRear, p);
    if (!in_view) p_body_.push_back(p);
  }
}

}  // namespace adit
