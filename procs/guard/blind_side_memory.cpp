// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/blind_side_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr double kCellM = 0.1;
constexpr double kReachM = 8.0;     // from the vehicle; farther cells are forgotten
constexpr double kDrivenM = 60.0;   // path length, after which driven ground is forgotten
constexpr double kRangeM = 5.0;     // of a beam that counts
constexpr double kShortOfM = 0.05;  // before the obstacle that a beam hit
constexpr double kJumpM = 0.5;      // maximum step between poses
constexpr double kMovedM = 0.05;    // between two scans, or two footprints, that are added
constexpr double kTurnedRad = 0.05;
constexpr double kSampleM = 0.05;  // along the motion and along the edge of the footprint
constexpr double kInsideM = 0.02;  // the edge of the footprint that must be known lies inside it

std::int64_t cell_of(const Eigen::Vector2d& p_odom) {
  const auto index = [](double value) {
    return static_cast<std::int64_t>(std::floor(std::clamp(value / kCellM, -1e9, 1e9)));
  };
  return index(p_odom.x()) * 4'000'000'007 + index(p_odom.y());
}

bool has_moved(const std::optional<Pose2>& from, const Pose2& to) {
  if (!from) return true;
  const Pose2 step = between(*from, to);
  return step.translation().norm() > kMovedM || std::abs(step.theta) > kTurnedRad;
}

}  // namespace

BlindSideMemory::BlindSideMemory(const Vehicle& vehicle, const LaserMount& laser)
    : vehicle_(vehicle), laser_(laser) {}

void BlindSideMemory::move_to(const Pose2& T_odom_body) {
  if (T_odom_body_ && between(*T_odom_body_, T_odom_body).translation().norm() > kJumpM) {
    seen_.clear();
    driven_.clear();
    driven_in_order_.clear();
    T_odom_observed_.reset();
    T_odom_footprint_.reset();
  }
  T_odom_body_ = T_odom_body;
  if (has_moved(T_odom_footprint_, T_odom_body)) add_footprint();
  if ((T_odom_body.translation() - p_odom_pruned_).norm() > 1.0) forget_far_cells();
}

void BlindSideMemory::observe(const LaserPoints& points) {
  if (!T_odom_body_ || !has_moved(T_odom_observed_, *T_odom_body_)) return;
  T_odom_observed_ = T_odom_body_;
  const Eigen::Vector2d p_odom_laser = *T_odom_body_ * laser_.T_body_laser.translation();
  for (const Eigen::Vector2d& p_body : points.p_body) {
    if (p_body.allFinite()) add_line(p_odom_laser, *T_odom_body_ * p_body);
  }
}

double BlindSideMemory::known_m(const ArcMotion& motion, double within_m) const {
  if (!T_odom_body_) return 0.0;
  const double sign = direction_of(motion);
  double known = 0.0;
  for (double distance_m = kSampleM; known < within_m; distance_m += kSampleM) {
    // Never less than a sample, which is more than kInsideM: the vehicle cannot creep onto new
    // ground.
    const double signed_m = sign * distance_m;
    const Pose2 T_body_ahead = along_arc(signed_m, signed_m * motion.curvature_1_m);
    if (!is_known(*T_odom_body_ * T_body_ahead)) return known;
    known = std::min(distance_m, within_m);
  }
  return known;
}

/// Whether all of the outline is known: what is inside has been passed by the outline before.
bool BlindSideMemory::is_known(const Pose2& T_odom_body) const {
  const double x_m = std::max(0.0, 0.5 * vehicle_.length_m - kInsideM);
  const double y_m = std::max(0.0, 0.5 * vehicle_.width_m - kInsideM);
  const auto known = [&](double x, double y) {
    const Eigen::Vector2d p_odom = T_odom_body * Eigen::Vector2d(x, y);
    const std::int64_t cell = cell_of(p_odom);
    return is_under_body(p_odom) || seen_.contains(cell) || driven_.contains(cell);
  };
  const int along = static_cast<int>(std::ceil(2.0 * x_m / kSampleM));
  for (int i = 0; i <= along; ++i) {
    const double x = -x_m + 2.0 * x_m * i / along;
    if (!known(x, -y_m) || !known(x, y_m)) return false;
  }
  const int across = static_cast<int>(std::ceil(2.0 * y_m / kSampleM));
  for (int i = 0; i <= across; ++i) {
    const double y = -y_m + 2.0 * y_m * i / across;
    if (!known(-x_m, y) || !known(x_m, y)) return false;
  }
  return true;
}

/// The body is up to kMovedM ahead of the last footprint that was added.
bool BlindSideMemory::is_under_body(const Eigen::Vector2d& p_odom) const {
  const Eigen::Vector2d p_body = T_odom_body_->inverse() * p_odom;
  return std::abs(p_body.x()) <= 0.5 * vehicle_.length_m &&
         std::abs(p_body.y()) <= 0.5 * vehicle_.width_m;
}

void BlindSideMemory::add_footprint() {
  if (T_odom_footprint_)
    odometer_m_ += between(*T_odom_footprint_, *T_odom_body_).translation().norm();
  T_odom_footprint_ = T_odom_body_;
  const int along = static_cast<int>(std::ceil(vehicle_.length_m / kSampleM));
  const int across = static_cast<int>(std::ceil(vehicle_.width_m / kSampleM));
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j <= across; ++j) {
      const Eigen::Vector2d p_body(vehicle_.length_m * (static_cast<double>(i) / along - 0.5),
                                   vehicle_.width_m * (static_cast<double>(j) / across - 0.5));
      const std::int64_t cell = cell_of(*T_odom_body_ * p_body);
      driven_[cell] = odometer_m_;
      driven_in_order_.emplace_back(cell, odometer_m_);
    }
  }
  forget_old_cells();
}

/// A cell that was driven again since is in the order twice.
void BlindSideMemory::forget_old_cells() {
  while (!driven_in_order_.empty() && driven_in_order_.front().second < odometer_m_ - kDrivenM) {
    const auto& [cell, at_m] = driven_in_order_.front();
    if (const auto found = driven_.find(cell); found != driven_.end() && found->second == at_m)
      driven_.erase(found);
    driven_in_order_.pop_front();
  }
}

void BlindSideMemory::add_line(const Eigen::Vector2d& p_odom_from,
                               const Eigen::Vector2d& p_odom_to) {
  const Eigen::Vector2d line = p_odom_to - p_odom_from;
  const double range_m = line.norm();
  const double end_m = std::min(range_m - kShortOfM, kRangeM);
  for (double distance_m = 0.0; distance_m < end_m; distance_m += kSampleM) {
    seen_.insert(cell_of(p_odom_from + distance_m / range_m * line));
  }
}

/// Cells are erased by their place, which the key does not hold: what is near is added again.
void BlindSideMemory::forget_far_cells() {
  p_odom_pruned_ = T_odom_body_->translation();
  const auto reach = static_cast<int>(kReachM / kCellM);
  std::unordered_set<std::int64_t> near;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const std::int64_t cell = cell_of(p_odom_pruned_ + kCellM * Eigen::Vector2d(i, j));
      if (seen_.contains(cell)) near.insert(cell);
    }
  }
  seen_ = std::move(near);
}

}  // namespace adit
