// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/narrow_passages.hpp"

#include <algorithm>
#include <cstddef>

namespace adit {
namespace {

constexpr double kNearerM = 1.0;  // by which a scan is from nearer
constexpr int kBlockedMin = 2;    // a verdict rests on two scans
constexpr double kPassedM = 1.0;  // behind the place where paths ended, as planning counts it
constexpr double kAtPassageM = 2.0;

/// Whether a body is just behind the place where paths ended.
bool has_passed(const std::optional<Pose2>& T_odom_end, const Pose2& T_odom_body) {
  if (!T_odom_end) return false;
  const Eigen::Vector2d p_end_body = T_odom_end->inverse() * T_odom_body.translation();
  return p_end_body.x() >= kPassedM && p_end_body.norm() <= kAtPassageM;
}

}  // namespace

void NarrowPassages::add_doubt(FrontierId frontier, const Reach& reach) {
  const auto [passage, is_new] = passages_.try_emplace(frontier, Passage{reach});
  if (is_new || reach.distance_m > passage->second.nearest.distance_m) return;
  passage->second = {reach};
}

void NarrowPassages::add_blocked(FrontierId frontier, double distance_m) {
  const auto passage = passages_.find(frontier);
  if (passage == passages_.end()) return;
  if (distance_m <= passage->second.nearest.distance_m - kNearerM) ++passage->second.blocked_near;
}

void NarrowPassages::add_path(const std::vector<PathPoint>& points) {
  for (auto& [frontier, passage] : passages_) {
    double s_m = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Pose2& T_odom_body = points[i].T_odom_body;
      s_m += (T_odom_body.translation() - points[i - 1].T_odom_body.translation()).norm();
      if (!has_passed(passage.nearest.T_odom_end, T_odom_body)) continue;
      passage.blocked_near = 0;
      passage.nearest.distance_m = std::min(passage.nearest.distance_m, s_m - kPassedM);
      break;
    }
  }
}

void NarrowPassages::add_pose(const Pose2& T_odom_body) {
  std::erase_if(passages_, [&](const auto& entry) {
    return has_passed(entry.second.nearest.T_odom_end, T_odom_body);
  });
}

void NarrowPassages::reset_odom() {
  for (auto& [frontier, passage] : passages_) passage.nearest.T_odom_end.reset();
}

bool NarrowPassages::is_doubtful(FrontierId frontier) const {
  const auto passage = passages_.find(frontier);
  return passage != passages_.end() && passage->second.blocked_near < kBlockedMin;
}

}  // namespace adit
