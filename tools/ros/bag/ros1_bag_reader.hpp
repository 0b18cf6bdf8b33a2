// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/ros/bag/bag_reader.hpp"

namespace adit {

/// Whether bytes begin as a bag of ROS 1.
bool is_ros1_bag(std::span<const std::uint8_t> begin);

/// A record of a ROS 1 bag.
struct Ros1Record {
  std::uint8_t op = 0;
  std::span<const std::uint8_t> header;
  std::span<const std::uint8_t> data;
};

/// The records in a bag, or in the content of a chunk. Where no record begins, it searches for the
/// next one: for any, unless there are compressed chunks, in which something that looks like a
/// message is none.
class Ros1Records {
 public:
  explicit Ros1Records(std::span<const std::uint8_t> bytes, std::size_t from = 0)
      : bytes_(bytes), at_(from) {}

  std::optional<Ros1Record> next();

  [[nodiscard]] std::size_t position() const { return at_; }
  /// The record that the end of the bytes truncates, if its header is whole; after the last one.
  [[nodiscard]] const std::optional<Ros1Record>& truncated() const { return truncated_; }
  [[nodiscard]] const BagDamage& damage() const { return damage_; }

 private:
  std::optional<Ros1Record> record_at(std::size_t at, bool& fits);
  bool skip_to_next();
  [[nodiscard]] bool may_continue_with(const Ros1Record& record);

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::optional<Ros1Record> truncated_;
  std::optional<bool> has_compressed_chunks_;  ///< once it is known
  BagDamage damage_;
};

/// A bag of ROS 1, format 2.0 (https://wiki.ros.org/Bags/Format/2.0), also without its index:
/// chunks without compression, with bzip2 or LZ4, and messages outside of chunks. Messages have the
/// order of the file. Of a damaged chunk those before the damage are read.
class Ros1BagReader final : public BagReader {
 public:
  /// `bytes` must outlive this. Throws std::runtime_error if they are of another format.
  explicit Ros1BagReader(std::span<const std::uint8_t> bytes);

  std::optional<BagMessage> next() override;
  [[nodiscard]] const std::vector<BagTopic>& topics() const override { return topics_.all(); }
  [[nodiscard]] BagDamage damage() const override;
  [[nodiscard]] double fraction_read() const override;

 private:
  void read_index();
  void open_chunk(const Ros1Record& chunk);
  void close_chunk();
  void add_connection(const Ros1Record& record);
  std::optional<BagMessage> message(const Ros1Record& record);
  std::optional<BagMessage> next_in_chunk();

  std::span<const std::uint8_t> bytes_;
  BagTopics topics_;
  std::map<std::uint32_t, std::size_t> connections_;  ///< topic by connection
  Ros1Records records_;
  std::vector<std::uint8_t> chunk_;  ///< content of the current chunk
  std::size_t chunk_missing_ = 0;    ///< bytes of it that could not be unpacked
  std::optional<Ros1Records> in_chunk_;
  bool ended_ = false;
  std::size_t expected_ = 0;  ///< messages by the index
  std::size_t messages_ = 0;
  BagDamage damage_;
};

}  // namespace adit
