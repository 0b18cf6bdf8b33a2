// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/ros/import/topic_choice.hpp"

namespace adit {

/// The stage in CONFIG of imported logs.
inline constexpr const char* kImportStage = "import";

struct BagImportOptions {
  TopicChoice topics;
  double cloud_spacing_m = 2.0;  ///< distance travelled from one 3D scan to the next
};

struct BagImport {
  TopicChoice topics;  ///< that were converted
  std::size_t scans = 0;
  std::size_t odometry = 0;
  std::size_t imu = 0;
  std::size_t clouds = 0;
  std::size_t rejected_scans = 0;
  std::vector<std::string> skipped;   ///< parts of the bag, without a verb
  std::vector<std::string> warnings;  ///< sentences
};

/// Converts a bag of ROS (ROS 1, rosbag2, MCAP) to an LCM log in the order of its recording:
/// LASER_FRONT, LASER_REAR, WHEEL_ODOMETRY and IMU with the times of their headers, CLOUD with
/// poses by odometry, and CONFIG with the mounts of the lasers by tf. Throws std::runtime_error if
/// the bag cannot be read or has no usable reading, or if the topics are ambiguous (choose_topics);
/// then there is no log.
BagImport import_bag(const std::filesystem::path& bag, const std::filesystem::path& lcm_log,
                     const BagImportOptions& options, const std::function<void(double)>& progress);

}  // namespace adit
