// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/messages/mapping/odometry.hpp"
#include "viewer/scene/map_frame.hpp"

namespace adit {

/// The path driven so far, thinned, as poses that follow the pose graph.
class AnchoredPath {
 public:
  /// When it is reached, every second pose is dropped.
  static constexpr std::size_t kPosesMax = 40'000;

  struct Pose {
    std::int64_t utime = 0;
    AnchoredPose anchored;
    double distance_m = 0.0;  ///< along the path from its start
    bool homeward = false;    ///< after the decision to return
  };

  /// `frame` must outlive this.
  explicit AnchoredPath(const MapFrame& frame) : frame_(frame) {}

  /// Returns whether the path has become longer.
  bool add(const StampedPose& pose);
  void set_homeward(bool homeward) { homeward_ = homeward; }

  [[nodiscard]] const std::vector<Pose>& poses() const { return poses_; }

 private:
  const MapFrame& frame_;
  std::vector<Pose> poses_;
  LevelPose T_odom_last_;
  double step_m_ = 0.1;
  bool homeward_ = false;
};

}  // namespace adit
