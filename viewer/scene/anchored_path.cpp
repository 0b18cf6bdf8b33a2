// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/anchored_path.hpp"

namespace adit {

bool AnchoredPath::add(const StampedPose& pose) {
  const LevelPose T_odom_body{pose.T_odom_body, pose.z_m};
  if (!poses_.empty() && pose.utime <= poses_.back().utime) return false;
  const double step_m = (T_odom_body.translation() - T_odom_last_.translation()).norm();
  if (!poses_.empty() && step_m < step_m_) return false;
  const double distance_m = poses_.empty() ? 0.0 : poses_.back().distance_m + step_m;
  poses_.push_back({pose.utime, frame_.anchored(T_odom_body), distance_m, homeward_});
  T_odom_last_ = T_odom_body;
  if (poses_.size() < kPosesMax) return true;
  for (std::size_t i = 0; 2 * i < poses_.size(); ++i) poses_[i] = poses_[2 * i];
  poses_.resize((poses_.size() + 1) / 2);
  step_m_ *= 2.0;
  return true;
}

}  // namespace adit
