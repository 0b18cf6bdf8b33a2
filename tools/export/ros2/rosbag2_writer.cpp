// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/ros2/rosbag2_writer.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/bus/node/version.hpp"
#include "tools/export/ros2/ros2_messages.hpp"

namespace adit {
namespace {

/// Keep all, reliable, transient local: who subscribes later gets them, too.
constexpr const char* kLatched =
    "- history: 2\n  depth: 0\n  reliability: 1\n  durability: 1\n"
    "  deadline:\n    sec: 2147483647\n    nsec: 4294967295\n"
    "  lifespan:\n    sec: 2147483647\n    nsec: 4294967295\n"
    "  liveliness: 1\n"
    "  liveliness_lease_duration:\n    sec: 2147483647\n    nsec: 4294967295\n"
    "  avoid_ros_namespace_conventions: false";

/// A string of YAML.
std::string quoted_yaml(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result + "\"";
}

}  // namespace

Rosbag2Writer::Rosbag2Writer(const std::filesystem::path& file)
    : file_(file), writer_(file, "ros2") {}

void Rosbag2Writer::write(const std::string& topic, const char* type, std::int64_t log_utime,
                          std::int64_t utime, const std::string& bytes) {
  const auto [entry, is_new] = topics_.try_emplace(topic);
  Topic& known = entry->second;
  if (is_new) {
    known.type = type;
    if (topic == "/tf_static") known.qos = kLatched;
    known.channel = writer_.add_channel(topic, "cdr", {type, "ros2msg", ros2::definition(type)},
                                        {{"offered_qos_profiles", known.qos}});
  }
  from_utime_ = writer_.messages() == 0 ? log_utime : std::min(from_utime_, log_utime);
  to_utime_ = std::max(to_utime_, log_utime);
  writer_.write(known.channel, log_utime, utime, bytes);
  ++known.messages;
}

void Rosbag2Writer::close() {
  writer_.write({"adit", {{"version", version()}}});
  writer_.close();
}

std::string Rosbag2Writer::metadata() const {
  const std::string name = quoted_yaml(file_.filename().string());
  std::string text =
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n" + times("  ") +
      fmt::format("  message_count: {}\n  topics_with_message_count:\n", writer_.messages());
  for (const auto& [topic, known] : topics_) {
    text += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n"
        "        serialization_format: cdr\n        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        topic, known.type, quoted_yaml(known.qos), known.messages);
  }
  text += fmt::format(
      "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - {0}\n"
      "  files:\n    - path: {0}\n",
      name);
  return text + times("      ") + fmt::format("      message_count: {}\n", writer_.messages());
}

std::string Rosbag2Writer::times(const char* indent) const {
  return fmt::format(
      "{0}starting_time:\n{0}  nanoseconds_since_epoch: {1}\n"
      "{0}duration:\n{0}  nanoseconds: {2}\n",
      indent, 1000 * from_utime_, 1000 * (to_utime_ - from_utime_));
}

}  // namespace adit
