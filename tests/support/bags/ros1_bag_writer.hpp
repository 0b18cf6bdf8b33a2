// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace adit::test {

/// Writes a bag of ROS 1 as https://wiki.ros.org/Bags/Format/2.0 describes it, in memory.
class Ros1BagWriter {
 public:
  /// `compression`: none, bz2 or lz4.
  explicit Ros1BagWriter(std::string compression) : compression_(std::move(compression)) {}

  void write(const std::string& topic, const std::string& type, std::int64_t utime,
             std::string_view data);
  /// Ends the chunk, with the index of its messages.
  void end_chunk();

  /// The bag, with the index at its end, or as it is while it is recorded.
  std::vector<std::uint8_t> closed();
  std::vector<std::uint8_t> active();

 private:
  std::string compression_;
  std::string chunk_;
  std::map<std::string, std::uint32_t> connections_;
  std::string connection_records_;
  std::map<std::uint32_t, std::uint32_t> counts_;  ///< messages in the chunk by connection
  std::string chunks_;
  std::string chunk_infos_;
  std::uint32_t n_chunks_ = 0;
};

/// Fields of a serialized message of ROS 1: without alignment, little-endian.
class Ros1Bytes {
 public:
  Ros1Bytes& u8(std::uint8_t value) { return number(value, 1); }
  Ros1Bytes& u32(std::uint64_t value) { return number(value, 4); }
  Ros1Bytes& f32(float value);
  Ros1Bytes& f64(double value);
  Ros1Bytes& text(std::string_view value);
  Ros1Bytes& header(std::int64_t utime, std::string_view frame);
  Ros1Bytes& raw(std::string_view value);

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  Ros1Bytes& number(std::uint64_t value, int size);

  std::string bytes_;
};

/// sensor_msgs/LaserScan from −90° on, 1° apart.
std::string ros1_laser_scan(std::int64_t utime, std::string_view frame,
                            const std::vector<float>& ranges_m);

}  // namespace adit::test
