// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/bag_import.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/node/version.hpp"
#include "common/config/config.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/sensing.hpp"
#include "tools/log_times/reorder_buffer.hpp"
#include "tools/ros/bag/bag_files.hpp"
#include "tools/ros/import/imported_laser.hpp"
#include "tools/ros/import/level_scan.hpp"
#include "tools/ros/import/placed_cloud.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr double kSurveyShare = 0.4;  // of the progress

/// The conversion of the messages of a bag, one by one.
class Conversion {
 public:
  Conversion(const BagSurvey& survey, const TopicChoice& topics, double cloud_spacing_m,
             LogWriter& log)
      : survey_(survey),
        topics_(topics),
        spacing_(cloud_spacing_m),
        in_order_([&log](const LogEvent& event) {
          log.write({event.utime, event.channel, event.data});
        }) {
    result_.topics = topics;
    result_.skipped = survey.warnings;
    add_laser(LaserId::kFront, topics.front);
    add_laser(LaserId::kRear, topics.rear);
    tf_odometry_ = topics.odometry == "tf" ? survey.odometry_frame(topics.base_frame) : "";
    if (!topics.clouds.empty() && topics.clouds != TopicChoice::kNone) require_odometry();
    write_config();
  }

  void take(const BagTopic& topic, const BagMessage& message) {
    const RosMessage bytes{message.data, topic.encoding};
    log_utime_ = message.log_utime;
    for (const ImportedLaser& laser : lasers_) {
      if (laser.topic->topic == topic) add_scan(laser, bytes);
    }
    if (topic.name == topics_.odometry && topic.type == ros_types::kOdometry) add_odometry(bytes);
    if (!tf_odometry_.empty() &&
        (topic.type == ros_types::kTransforms || topic.type == ros_types::kEarlyTransforms)) {
      add_odometry_of_tf(bytes);
    }
    if (topic.name == topics_.imu && topic.type == ros_types::kImu) add_imu(bytes);
    if (topic.name == topics_.clouds && topic.type == ros_types::kPointCloud2) add_cloud(bytes);
  }

  BagImport finish() {
    in_order_.flush();
    for (const auto& [reason, count] : rejected_)
      result_.skipped.push_back(fmt::format("{} {}", count, reason));
    return std::move(result_);
  }

 private:
  void add_laser(LaserId id, const std::string& name) {
    if (survey_.find(name) == nullptr) return;
    lasers_.push_back(ImportedLaser::of(id, name, survey_, topics_, result_.warnings));
  }

  void require_odometry() const {
    if (topics_.odometry != TopicChoice::kNone && !topics_.odometry.empty()) return;
    throw std::runtime_error(
        "3D scans need odometry for their poses, and the bag has neither Odometry nor such a frame "
        "in tf");
  }

  void write_config() {
    Lasers lasers;
    for (const ImportedLaser& laser : lasers_)
      (laser.id == LaserId::kFront ? lasers.front : lasers.rear) = laser.level.mount;
    log_utime_ = survey_.first_utime;
    if (lasers_.empty()) return;
    write(channels::kConfig, to_message(ConfigSnapshot{log_utime_, kImportStage, version(),
                                                       to_yaml(lasers, Lasers::kSection)}));
  }

  template <class Message>
  void write(std::string_view channel, const Message& message) {
    in_order_.add(log_utime_, {log_utime_, std::string(channel), encode(message)});
  }

  void reject(const std::string& reason) { ++rejected_[reason]; }

  /// The time of a header; that of the recording where the header has none.
  [[nodiscard]] std::int64_t time_of(std::int64_t header_utime) const {
    return header_utime > 0 ? header_utime : log_utime_;
  }

  void add_scan(const ImportedLaser& laser, const RosMessage& bytes) {
    const auto scan = laser.is_cloud() ? slice(laser, bytes) : planar_scan(laser, bytes);
    if (!scan) {
      ++result_.rejected_scans;
      return;
    }
    ++result_.scans;
    write(laser_channel(laser.id), to_message(*scan));
  }

  std::optional<LaserScan> planar_scan(const ImportedLaser& laser, const RosMessage& bytes) {
    auto read = laser.topic->is(ros_types::kLaserScan) ? ros_laser_scan(bytes)
                                                       : ros_multi_echo_laser_scan(bytes);
    if (!read) {
      reject("scans that cannot be decoded");
      return std::nullopt;
    }
    read->utime = time_of(read->utime);
    if (laser.is_elsewhere(survey_.frames, read->utime)) {
      reject("scans of a laser that had turned from its level mount");
      return std::nullopt;
    }
    auto scan = level_scan(*read, laser.level.upside_down);
    if (!scan) reject("scans with beams that no laser has");
    return scan;
  }

  std::optional<LaserScan> slice(const ImportedLaser& laser, const RosMessage& bytes) {
    auto cloud = ros_point_cloud(bytes);
    if (!cloud) {
      reject("point clouds that cannot be decoded");
      return std::nullopt;
    }
    const Eigen::Matrix3f R_level_sensor = laser.T_body_laser.linear().cast<float>();
    for (Eigen::Vector3f& p : cloud->points) p = R_level_sensor * p;
    LaserScan scan = level_scan(cloud->points);
    scan.utime = time_of(cloud->utime);
    return scan;
  }

  void add_odometry(const RosMessage& bytes) {
    const auto reading = ros_odometry(bytes);
    if (!reading) return reject("odometry messages that cannot be decoded");
    const auto T_child_body =
        survey_.frames.lookup(reading->child_frame, topics_.base_frame, reading->utime);
    const Eigen::Isometry3d T_wheel_body =
        reading->T_frame_child * T_child_body.value_or(Eigen::Isometry3d::Identity());
    add_odometry(reading->utime, T_wheel_body);
  }

  void add_odometry(std::int64_t utime, const Eigen::Isometry3d& T_wheel_body) {
    ++result_.odometry;
    write(channels::kWheelOdometry,
          to_message(WheelOdometry{time_of(utime), in_plan(T_wheel_body)}));
  }

  void add_odometry_of_tf(const RosMessage& bytes) {
    const auto transforms = ros_transforms(bytes);
    if (!transforms) return reject("transforms that cannot be decoded");
    for (const RosTransform& transform : *transforms) {
      if (transform.child != tf_odometry_) continue;
      const auto T_child_body =
          survey_.frames.lookup(tf_odometry_, topics_.base_frame, transform.utime);
      add_odometry(transform.utime,
                   transform.T_parent_child * T_child_body.value_or(Eigen::Isometry3d::Identity()));
    }
  }

  void add_imu(const RosMessage& bytes) {
    const auto reading = ros_imu(bytes);
    if (!reading) return reject("IMU messages that cannot be decoded");
    const std::int64_t utime = time_of(reading->utime);
    const auto T_body_imu = survey_.frames.lookup(topics_.base_frame, reading->frame, utime);
    if (!T_body_imu) return reject("readings of an IMU that tf does not connect with the body");
    ++result_.imu;
    write(channels::kImu,
          to_message(ImuReading{utime, T_body_imu->linear() * reading->angular_velocity,
                                T_body_imu->linear() * reading->linear_acceleration}));
  }

  /// The pose of the body in the frame of the odometry.
  [[nodiscard]] std::optional<Eigen::Isometry3d> pose_at(std::int64_t utime) const {
    const std::string& base = topics_.base_frame;
    if (!tf_odometry_.empty())
      return survey_.frames.lookup(survey_.frames.parent(tf_odometry_).value(), base, utime);
    const SurveyedTopic* const odometry = survey_.find(topics_.odometry);
    if (odometry == nullptr) return std::nullopt;
    const auto T_odom_child =
        odometry->poses.lookup(SurveyedTopic::kOrigin, SurveyedTopic::kChild, utime);
    if (!T_odom_child) return std::nullopt;
    const auto T_child_body = survey_.frames.lookup(odometry->child_frame, base, utime);
    return *T_odom_child * T_child_body.value_or(Eigen::Isometry3d::Identity());
  }

  void add_cloud(const RosMessage& bytes) {
    const auto cloud = ros_point_cloud(bytes);
    if (!cloud) return reject("3D scans that cannot be decoded");
    const std::int64_t utime = time_of(cloud->utime);
    const auto T_odom_body = pose_at(utime);
    const auto T_body_sensor = survey_.frames.lookup(topics_.base_frame, cloud->frame, utime);
    if (!T_odom_body || !T_body_sensor)
      return reject("3D scans of which odometry and tf do not give the pose");
    if (!start_) start_ = in_space(in_plan(*T_odom_body), T_odom_body->translation().z());
    const Eigen::Isometry3d T_start_body = start_->inverse() * *T_odom_body;
    if (!spacing_.take(T_start_body.translation())) return;
    Cloud placed = placed_cloud(cloud->points, utime, *T_body_sensor, T_start_body);
    placed.id = static_cast<std::int32_t>(result_.clouds++);
    for (const CloudFragment& fragment : split(placed))
      write(channels::kCloud, to_message(fragment));
  }

  const BagSurvey& survey_;
  TopicChoice topics_;
  std::vector<ImportedLaser> lasers_;
  std::string tf_odometry_;  ///< frame of which the pose in its parent is odometry
  CloudSpacing spacing_;
  ReorderBuffer<LogEvent> in_order_;
  std::int64_t log_utime_ = 0;              ///< of the current message
  std::optional<Eigen::Isometry3d> start_;  ///< T_odom_level of the first 3D scan
  std::map<std::string, std::size_t> rejected_;
  BagImport result_;
};

void require_other_file(const fs::path& bag, const fs::path& log) {
  std::error_code ignored;
  if (fs::equivalent(bag, log, ignored))
    throw std::runtime_error(fmt::format("input and output are the same file: {}", log.string()));
}

}  // namespace

BagImport import_bag(const fs::path& bag, const fs::path& lcm_log, const BagImportOptions& options,
                     const std::function<void(double)>& progress) {
  require_other_file(bag, lcm_log);
  const BagSurvey survey = survey_bag(bag, !options.topics.clouds.empty(),
                                      [&](double read) { progress(kSurveyShare * read); });
  const TopicChoice topics = choose_topics(survey, options.topics);
  LogWriter log(lcm_log, LogWriter::Name::kWhenClosed);
  Conversion conversion(survey, topics, options.cloud_spacing_m, log);
  std::vector<std::string> repeated;  // warnings of the survey
  const auto reader = open_bag(bag, repeated);
  while (const auto message = reader->next()) {
    conversion.take(reader->topics()[message->topic], *message);
    progress(kSurveyShare + (1.0 - kSurveyShare) * reader->fraction_read());
  }
  BagImport result = conversion.finish();
  if (result.scans + result.odometry + result.imu + result.clouds == 0) {
    throw std::runtime_error(
        fmt::format("no usable reading in {}{}", bag.string(),
                    result.skipped.empty() ? "" : ": only " + result.skipped.front()));
  }
  log.close();
  return result;
}

}  // namespace adit
