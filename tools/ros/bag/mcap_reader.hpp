// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/ros/bag/bag_reader.hpp"

namespace adit {

/// Whether bytes begin as an MCAP file.
bool is_mcap(std::span<const std::uint8_t> begin);

/// A record of an MCAP file.
struct McapRecord {
  std::uint8_t opcode = 0;
  std::span<const std::uint8_t> content;
};

/// An MCAP file (https://mcap.dev/spec), also without its index and end: chunks without
/// compression, with LZ4 or zstd, and messages outside of chunks. Messages have the order of the
/// file. A chunk whose checksum is wrong is skipped; of one that is truncated the messages up to
/// there are read. Where no record begins, the reader searches for the next chunk.
class McapReader final : public BagReader {
 public:
  /// `bytes` must outlive this. Throws std::runtime_error if they are of another format.
  explicit McapReader(std::span<const std::uint8_t> bytes);

  std::optional<BagMessage> next() override;
  [[nodiscard]] const std::vector<BagTopic>& topics() const override { return topics_.all(); }
  [[nodiscard]] BagDamage damage() const override;
  [[nodiscard]] double fraction_read() const override;

 private:
  struct Schema {
    std::string name;
  };

  void read_summary();
  std::optional<BagMessage> take(const McapRecord& record);
  void add_schema(std::span<const std::uint8_t> content);
  void add_channel(std::span<const std::uint8_t> content);
  std::optional<BagMessage> message(std::span<const std::uint8_t> content);
  void open_chunk(std::span<const std::uint8_t> content, bool truncated);
  std::optional<BagMessage> next_in_chunk();
  void skip_to_chunk();
  void add_corrupt(std::size_t bytes);

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ended_ = false;
  std::size_t expected_ = 0;  ///< messages by the summary
  std::size_t messages_ = 0;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, std::size_t> channels_;  ///< topic by channel
  BagTopics topics_;
  std::vector<std::uint8_t> chunk_;  ///< content of the current chunk
  std::size_t at_in_chunk_ = 0;
  BagDamage damage_;
};

}  // namespace adit
