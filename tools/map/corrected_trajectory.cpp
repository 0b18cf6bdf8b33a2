// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/corrected_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace adit {
namespace {

constexpr double kMetresPerRadian = 1.0;

/// Distance travelled up to each pose, rotation included [m].
std::vector<double> progress_of(const Trajectory& odometry) {
  std::vector<double> progress;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    if (i == 0) {
      progress.push_back(0.0);
      continue;
    }
    const Pose2 step = between(odometry[i - 1].pose, odometry[i].pose);
    progress.push_back(progress.back() + step.translation().norm() +
                       kMetresPerRadian * std::abs(step.theta));
  }
  return progress;
}

/// T_map_body by the correction of one anchor.
Pose2 apply_anchor(const MapAnchor& anchor, const Pose2& T_odom_body) {
  return anchor.T_map_local * between(anchor.T_odom_local, T_odom_body);
}

}  // namespace

Trajectory corrected_trajectory(const Trajectory& odometry, const std::vector<MapAnchor>& anchors) {
  if (anchors.empty() || odometry.empty()) return odometry;
  const std::vector<double> progress = progress_of(odometry);
  const auto progress_at = [&](std::int64_t utime) {
    const auto pose =
        std::lower_bound(odometry.begin(), odometry.end(), utime,
                         [](const TimedPose& p, std::int64_t t) { return p.utime < t; });
    const auto last = odometry.end() - 1;
    return progress[static_cast<std::size_t>(std::min(pose, last) - odometry.begin())];
  };

  Trajectory corrected;
  std::size_t k = 0;  // last anchor at or before the pose
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const auto& [utime, T_odom_body] = odometry[i];
    while (k + 1 < anchors.size() && anchors[k + 1].utime <= utime) ++k;
    Pose2 T_map_body = apply_anchor(anchors[k], T_odom_body);
    if (k + 1 < anchors.size() && utime > anchors[k].utime) {
      const double from = progress_at(anchors[k].utime);
      const double length = progress_at(anchors[k + 1].utime) - from;
      const double share = length > 0.0 ? (progress[i] - from) / length : 0.0;
      T_map_body = blend(T_map_body, apply_anchor(anchors[k + 1], T_odom_body), share);
    }
    corrected.push_back({utime, T_map_body});
  }
  return corrected;
}

}  // namespace adit
