// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/topic_options.hpp"

namespace adit {

void add_topic_options(CLI::App& command, TopicChoice& topics) {
  constexpr const char* kGroup = "Topics of a bag (none: nothing)";
  const auto add = [&command](const char* name, std::string& value, const char* help) {
    return command.add_option(name, value, help)->type_name("TOPIC")->group(kGroup);
  };
  add("--front", topics.front,
      "Laser that looks ahead: LaserScan, MultiEchoLaserScan, PointCloud2");
  add("--rear", topics.rear, "Laser that looks back");
  add("--odometry", topics.odometry, "Odometry, or tf");
  add("--imu", topics.imu, "Imu");
  add("--clouds", topics.clouds, "PointCloud2 to convert to 3D scans, one every 2 m");
  add("--base-frame", topics.base_frame, "Frame of tf that is the body")->type_name("FRAME");
}

}  // namespace adit
