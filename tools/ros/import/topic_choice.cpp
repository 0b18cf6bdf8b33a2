// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/topic_choice.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"
#include "tools/ros/bag/bag_files.hpp"
#include "tools/ros/import/level_scan.hpp"

namespace adit {
namespace {

using Topics = std::vector<const SurveyedTopic*>;

std::string text_of(const SurveyedTopic& topic) {
  return fmt::format("{} ({}, {} message{})", topic.topic.name, topic.topic.type, topic.messages,
                     topic.messages == 1 ? "" : "s");
}

std::string text_of(const Topics& topics) {
  std::vector<std::string> texts;
  for (const SurveyedTopic* topic : topics) texts.push_back(text_of(*topic));
  return fmt::format("{}", fmt::join(texts, ", "));
}

template <class Predicate>
Topics topics_that(const BagSurvey& survey, const Predicate& predicate) {
  Topics found;
  for (const SurveyedTopic& topic : survey.topics) {
    if (topic.messages > 0 && predicate(topic)) found.push_back(&topic);
  }
  return found;
}

Topics topics_of(const BagSurvey& survey, std::string_view type) {
  return topics_that(survey, [type](const SurveyedTopic& topic) { return topic.is(type); });
}

[[noreturn]] void fail_ambiguous(const std::string& what, const Topics& topics,
                                 const std::string& option) {
  throw std::runtime_error(fmt::format("{} topics could be {}; choose with {} TOPIC: {}",
                                       topics.size(), what, option, text_of(topics)));
}

/// A topic that was named, of one of these types.
void require_topic(const BagSurvey& survey, const std::string& name, const std::string& option,
                   const std::vector<std::string_view>& types) {
  if (name.empty() || name == TopicChoice::kNone) return;
  const SurveyedTopic* const topic = survey.find(name);
  if (topic == nullptr) {
    throw std::runtime_error(
        fmt::format("{} {}: no such topic; there are {}", option, quote(name), survey.text()));
  }
  const bool fits =
      std::ranges::any_of(types, [topic](std::string_view type) { return topic->is(type); });
  if (!fits) {
    throw std::runtime_error(fmt::format("{} {}: is {}, not {}", option, quote(name),
                                         text_of(*topic), fmt::join(types, " or ")));
  }
}

/// The reading of the messages of one topic, which tell about it.
class TopicReader {
 public:
  TopicReader(BagSurvey& survey, std::map<std::string, SurveyedTopic>& topics, bool with_poses)
      : survey_(survey), topics_(topics), with_poses_(with_poses) {}

  void read(const BagTopic& topic, const BagMessage& message) {
    const std::string key = topic.name + "\n" + topic.type + "\n" + topic.encoding;
    SurveyedTopic& known = topics_.try_emplace(key, SurveyedTopic{topic}).first->second;
    const RosMessage bytes{message.data, topic.encoding};
    if (known.messages++ == 0) read_first(known, bytes);
    if (with_poses_ && known.is(ros_types::kOdometry)) add_pose(known, bytes);
    const bool is_static = topic.name.ends_with("tf_static");
    if (known.is(ros_types::kTransforms) || known.is(ros_types::kEarlyTransforms)) {
      for (const RosTransform& transform :
           ros_transforms(bytes).value_or(std::vector<RosTransform>())) {
        survey_.frames.add(transform, is_static);
      }
    }
  }

 private:
  static void add_pose(SurveyedTopic& topic, const RosMessage& bytes) {
    const auto reading = ros_odometry(bytes);
    if (!reading) return;
    topic.poses.add(
        {reading->utime, SurveyedTopic::kOrigin, SurveyedTopic::kChild, reading->T_frame_child},
        false);
  }

  void read_first(SurveyedTopic& topic, const RosMessage& bytes) const {
    if (topic.is_laser()) {
      const auto scan = topic.is(ros_types::kLaserScan) ? ros_laser_scan(bytes)
                                                        : ros_multi_echo_laser_scan(bytes);
      if (!scan) return;
      topic.frame = scan->frame;
      topic.range_min_m = scan->range_min_m;
      topic.range_max_m = scan->range_max_m;
      topic.timing = timing_of(*scan);
    } else if (topic.is(ros_types::kPointCloud2)) {
      if (const auto cloud = ros_point_cloud(bytes)) topic.frame = cloud->frame;
    } else if (topic.is(ros_types::kImu)) {
      if (const auto reading = ros_imu(bytes)) topic.frame = reading->frame;
    } else if (topic.is(ros_types::kOdometry)) {
      const auto reading = ros_odometry(bytes);
      if (!reading) return;
      topic.frame = reading->frame;
      topic.child_frame = reading->child_frame;
    }
  }

  BagSurvey& survey_;
  std::map<std::string, SurveyedTopic>& topics_;
  bool with_poses_;
};

void choose_odometry(const BagSurvey& survey, TopicChoice& choice) {
  require_topic(survey, choice.odometry == "tf" ? "" : choice.odometry, "--odometry",
                {ros_types::kOdometry});
  if (!choice.odometry.empty()) return;
  const Topics topics = topics_of(survey, ros_types::kOdometry);
  if (topics.size() > 1) fail_ambiguous("the odometry", topics, "--odometry");
  if (!topics.empty()) choice.odometry = topics.front()->topic.name;
}

/// The frame that is the body: that of the odometry, else by its usual name, else the frame on
/// which the laser is mounted.
void choose_base(const BagSurvey& survey, TopicChoice& choice, const std::string& laser_frame) {
  if (!choice.base_frame.empty()) {
    if (survey.frames.has(choice.base_frame)) return;
    throw std::runtime_error(
        fmt::format("--base-frame {}: no such frame in tf", quote(choice.base_frame)));
  }
  std::vector<std::string> candidates{"base_link", "base_footprint"};
  const SurveyedTopic* const odometry = survey.find(choice.odometry);
  if (odometry != nullptr && !odometry->child_frame.empty())
    candidates.insert(candidates.begin(), odometry->child_frame);
  for (const std::string& frame : candidates) {
    if (!survey.frames.lookup(frame, laser_frame, 0)) continue;
    choice.base_frame = frame;
    return;
  }
  choice.base_frame = survey.frames.rigid_root(laser_frame);
}

/// Whether the laser looks to the rear; nothing if tf does not say.
std::optional<bool> looks_back(const BagSurvey& survey, const SurveyedTopic& topic,
                               TopicChoice choice) {
  choose_base(survey, choice, topic.frame);
  if (choice.base_frame == topic.frame) return std::nullopt;
  const auto T_body_laser = survey.frames.lookup(choice.base_frame, topic.frame, 0);
  if (!T_body_laser) return std::nullopt;
  return std::abs(in_plan(*T_body_laser).theta) > 0.5 * std::numbers::pi;
}

void choose_lasers(const BagSurvey& survey, TopicChoice& choice) {
  const std::vector<std::string_view> types{ros_types::kLaserScan, ros_types::kMultiEchoLaserScan,
                                            ros_types::kPointCloud2};
  require_topic(survey, choice.front, "--front", types);
  require_topic(survey, choice.rear, "--rear", types);
  if (!choice.front.empty()) return;
  Topics lasers = topics_that(survey, [&choice](const SurveyedTopic& topic) {
    return topic.is_laser() && topic.topic.name != choice.rear;
  });
  if (lasers.empty()) lasers = topics_of(survey, ros_types::kPointCloud2);
  if (lasers.empty()) {
    throw std::runtime_error(fmt::format(
        "no topic of a laser (LaserScan, MultiEchoLaserScan or PointCloud2); there are {}",
        survey.text()));
  }
  if (lasers.size() == 2 && choice.rear.empty() && lasers[0]->is_laser()) {
    const auto first = looks_back(survey, *lasers[0], choice);
    const auto second = looks_back(survey, *lasers[1], choice);
    if (first && second && *first != *second) {
      choice.front = lasers[*first ? 1 : 0]->topic.name;
      choice.rear = lasers[*first ? 0 : 1]->topic.name;
      return;
    }
  }
  if (lasers.size() > 1) fail_ambiguous("the laser", lasers, "--front");
  choice.front = lasers.front()->topic.name;
}

void choose_imu(const BagSurvey& survey, TopicChoice& choice) {
  require_topic(survey, choice.imu, "--imu", {ros_types::kImu});
  if (!choice.imu.empty()) return;
  const Topics topics = topics_of(survey, ros_types::kImu);
  if (topics.size() > 1) fail_ambiguous("the IMU", topics, "--imu");
  if (!topics.empty()) choice.imu = topics.front()->topic.name;
}

}  // namespace

bool SurveyedTopic::is(std::string_view type) const {
  return topic.type == type && (topic.encoding == "cdr" || topic.encoding == "ros1");
}

bool SurveyedTopic::is_laser() const {
  return is(ros_types::kLaserScan) || is(ros_types::kMultiEchoLaserScan);
}

const SurveyedTopic* BagSurvey::find(const std::string& name) const {
  const auto found = std::ranges::find_if(
      topics, [&name](const SurveyedTopic& topic) { return topic.topic.name == name; });
  return found == topics.end() ? nullptr : &*found;
}

std::string BagSurvey::odometry_frame(const std::string& base_frame) const {
  const std::string frame = frames.rigid_root(base_frame);
  const auto parent = frames.parent(frame);
  const bool is_odometry =
      parent && frames.moves(frame) && parent->find("odom") != std::string::npos;
  return is_odometry ? frame : "";
}

std::string BagSurvey::text() const {
  Topics all;
  for (const SurveyedTopic& topic : topics) all.push_back(&topic);
  return text_of(all);
}

BagSurvey survey_bag(const std::filesystem::path& bag, bool with_poses,
                     const std::function<void(double)>& progress) {
  BagSurvey survey;
  const auto reader = open_bag(bag, survey.warnings);
  std::map<std::string, SurveyedTopic> topics;
  TopicReader topic_reader(survey, topics, with_poses);
  while (const auto message = reader->next()) {
    if (survey.first_utime == 0) survey.first_utime = message->log_utime;
    topic_reader.read(reader->topics()[message->topic], *message);
    progress(reader->fraction_read());
  }
  for (auto& [key, topic] : topics) survey.topics.push_back(std::move(topic));
  if (survey.topics.empty())
    throw std::runtime_error(fmt::format("no message in {}", bag.string()));
  for (std::string& text : texts_of(reader->damage())) survey.warnings.push_back(std::move(text));
  return survey;
}

TopicChoice choose_topics(const BagSurvey& survey, TopicChoice wanted) {
  choose_odometry(survey, wanted);
  choose_lasers(survey, wanted);
  choose_imu(survey, wanted);
  require_topic(survey, wanted.clouds, "--clouds", {ros_types::kPointCloud2});
  const std::string& first = wanted.front != TopicChoice::kNone ? wanted.front : wanted.clouds;
  const SurveyedTopic* const laser = survey.find(first);
  choose_base(survey, wanted, laser ? laser->frame : "");
  if (wanted.odometry.empty() && !survey.odometry_frame(wanted.base_frame).empty())
    wanted.odometry = "tf";
  return wanted;
}

}  // namespace adit
