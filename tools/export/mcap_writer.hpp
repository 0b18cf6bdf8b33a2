// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/files/new_file.hpp"
#include "common/files/output_file.hpp"

namespace adit {

/// Writes an MCAP file (https://mcap.dev/spec, version 0): messages in chunks compressed with zstd,
/// each with an index, and a summary, so that readers find a time without reading the file. The
/// file has its name when it is complete. The same messages give the same bytes. Throws FileError.
class McapWriter {
 public:
  struct Schema {
    std::string name = {};
    std::string encoding = {};  ///< protobuf, jsonschema, ..
    std::string data = {};
  };

  struct Metadata {
    std::string name = {};
    std::map<std::string, std::string> values = {};
  };

  /// `profile`: what the messages of all channels are, "ros2", or empty.
  explicit McapWriter(const std::filesystem::path& path, const std::string& profile = {});
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Returns the id of the channel, which `write` takes. Channels with the same schema share it.
  std::uint16_t add_channel(const std::string& topic, const std::string& message_encoding,
                            const Schema& schema,
                            const std::map<std::string, std::string>& metadata = {});

  /// `log_utime`: of the recording, by which readers order messages; `utime`: of the content [µs
  /// since the epoch].
  void write(std::uint16_t channel, std::int64_t log_utime, std::int64_t utime,
             std::string_view data);
  void write(const Metadata& metadata);

  /// Completes the file and gives it its name.
  void close();

  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  struct IndexEntry {
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;
  };

  /// The messages of a chunk, by channel.
  using ChunkIndex = std::map<std::uint16_t, std::vector<IndexEntry>>;

  void append(const std::string& bytes);
  void append_record(std::uint8_t opcode, std::string_view content);
  void end_chunk();
  void write_summary();

  NewFile new_file_;
  OutputFile file_;
  std::uint64_t position_ = 0;

  std::vector<std::string> schemas_;   ///< records, id - 1 is the index
  std::vector<std::string> channels_;  ///< records, the id is the index
  std::map<std::string, std::uint16_t> schema_ids_;
  std::string chunk_;  ///< records
  ChunkIndex chunk_index_;
  std::uint64_t chunk_from_ns_ = 0;
  std::uint64_t chunk_to_ns_ = 0;

  std::string chunk_indexes_;  ///< records of the summary
  std::string metadata_indexes_;
  std::map<std::uint16_t, std::uint64_t> counts_;  ///< messages by channel
  std::uint32_t chunks_ = 0;
  std::uint32_t metadata_ = 0;
  std::uint64_t messages_ = 0;
  std::uint64_t from_ns_ = 0;
  std::uint64_t to_ns_ = 0;
};

}  // namespace adit
