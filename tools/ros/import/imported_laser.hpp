// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/sensing/laser_scan.hpp"
#include "tools/ros/import/frame_tree.hpp"
#include "tools/ros/import/level_scan.hpp"
#include "tools/ros/import/topic_choice.hpp"

namespace adit {

/// A laser of a bag, and where it is mounted on the body.
struct ImportedLaser {
  LaserId id = LaserId::kFront;
  const SurveyedTopic* topic = nullptr;
  std::string base_frame;  ///< that is the body
  Eigen::Isometry3d T_body_laser = Eigen::Isometry3d::Identity();
  bool moves = false;
  LevelMount
      level;  ///< with the ranges of the scans; of a point cloud, with the heading of the body

  /// The laser of a topic that the survey has, with its pose by tf; of a laser that moves, where it
  /// is the most level first. Adds a warning if tf does not connect it with the body. Throws
  /// std::runtime_error for a laser that is not level.
  static ImportedLaser of(LaserId id, const std::string& topic, const BagSurvey& survey,
                          const TopicChoice& choice, std::vector<std::string>& warnings);

  [[nodiscard]] bool is_cloud() const { return topic->is(ros_types::kPointCloud2); }
  /// Whether the laser has moved from there, so that it measures in another plane.
  [[nodiscard]] bool is_elsewhere(const FrameTree& frames, std::int64_t utime) const;
};

}  // namespace adit
