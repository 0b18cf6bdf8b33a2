// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viewer/scene/scene_parameters.hpp"

namespace adit {

struct Ros2Export {
  std::uint64_t messages = 0;
  std::size_t topics = 0;
  std::vector<std::string> warnings;  ///< skipped parts of the logs, one sentence each
};

/// Writes the logs of one mission, in any order, as a rosbag2: a folder with an MCAP file of
/// messages of ROS 2 and metadata.yaml. Topics: /scan_front, /scan_rear, /wheel_odometry, /imu,
/// /pose, /path, /cloud, /map, /tf and /tf_static with the frames map, odom, base_link,
/// laser_front, laser_rear. The same logs give the same bytes. Throws std::runtime_error if the
/// folder exists and is not empty, if a log cannot be read or has no such message, or if a file
/// cannot be written; then there is no folder.
Ros2Export export_ros2(const std::vector<std::filesystem::path>& logs,
                       const std::filesystem::path& folder, const SceneParameters& parameters,
                       const std::function<void(double)>& progress);

}  // namespace adit
