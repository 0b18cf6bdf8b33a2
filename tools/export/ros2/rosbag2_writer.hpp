// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "tools/export/mcap_writer.hpp"

namespace adit {

/// Writes the MCAP file of a rosbag2, and says what its metadata are. Throws FileError.
class Rosbag2Writer {
 public:
  explicit Rosbag2Writer(const std::filesystem::path& file);

  /// `type`: of ros2_messages. Times as in McapWriter.
  void write(const std::string& topic, const char* type, std::int64_t log_utime, std::int64_t utime,
             const std::string& bytes);
  /// Completes the file and gives it its name.
  void close();

  /// metadata.yaml of rosbag2, version 5.
  [[nodiscard]] std::string metadata() const;
  [[nodiscard]] std::uint64_t messages() const { return writer_.messages(); }
  [[nodiscard]] std::size_t topics() const { return topics_.size(); }

 private:
  struct Topic {
    std::string type = {};
    std::string qos = {};
    std::uint16_t channel = 0;
    std::uint64_t messages = 0;
  };

  [[nodiscard]] std::string times(const char* indent) const;

  std::filesystem::path file_;
  McapWriter writer_;
  std::map<std::string, Topic> topics_;
  std::int64_t from_utime_ = 0;
  std::int64_t to_utime_ = 0;
};

}  // namespace adit
