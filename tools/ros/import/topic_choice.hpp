// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/sensing/laser_scan.hpp"
#include "tools/ros/bag/bag_reader.hpp"
#include "tools/ros/import/frame_tree.hpp"

namespace adit {

/// A topic with what its messages tell about it.
struct SurveyedTopic {
  BagTopic topic;
  std::size_t messages = 0;
  std::string frame = {};                  ///< of the first message; empty for other types
  std::optional<double> range_min_m = {};  ///< of a laser
  std::optional<double> range_max_m = {};  ///< of a laser
  std::optional<ScanTiming> timing = {};   ///< of a laser that says it
  std::string child_frame = {};            ///< of odometry
  FrameTree poses = {};                    ///< of odometry: kChild in kOrigin, if they are wanted
  static constexpr const char* kOrigin = "origin";
  static constexpr const char* kChild = "child";

  /// Whether its messages can be read and have this type.
  [[nodiscard]] bool is(std::string_view type) const;
  [[nodiscard]] bool is_laser() const;
};

/// What a first pass over a bag finds.
struct BagSurvey {
  std::vector<SurveyedTopic> topics;  ///< in order of their names
  FrameTree frames;                   ///< of tf and tf_static, and of odometry
  std::int64_t first_utime = 0;       ///< of the recording
  std::vector<std::string> warnings;  ///< what cannot be read, without a verb

  [[nodiscard]] const SurveyedTopic* find(const std::string& name) const;
  /// The frame to which the body is attached and of which tf has the pose by odometry, by the name
  /// of its parent; empty if there is none.
  [[nodiscard]] std::string odometry_frame(const std::string& base_frame) const;
  /// All topics with types and numbers of messages, for one line.
  [[nodiscard]] std::string text() const;
};

/// `with_poses`: keeps the poses of odometry. Throws std::runtime_error if the bag cannot be read
/// or has no message.
BagSurvey survey_bag(const std::filesystem::path& bag, bool with_poses,
                     const std::function<void(double)>& progress);

/// What of a bag is converted. An empty name: chosen by `choose_topics`; "none": nothing.
struct TopicChoice {
  static constexpr const char* kNone = "none";

  std::string front;     ///< LaserScan, MultiEchoLaserScan, or PointCloud2 of which the level slice
  std::string rear;      ///< the same, on LASER_REAR
  std::string odometry;  ///< Odometry, or "tf": the motion of the body in tf
  std::string imu;
  std::string clouds;      ///< PointCloud2 as 3D scans; nothing unless it is named
  std::string base_frame;  ///< frame of ROS that is the body
};

/// Fills in what the bag leaves no doubt about. Throws std::runtime_error, one line with the topics
/// and the options, where a topic does not exist, has another type, or where several topics could
/// be meant.
TopicChoice choose_topics(const BagSurvey& survey, TopicChoice wanted);

}  // namespace adit
