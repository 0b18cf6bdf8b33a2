// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// A response of a laser with SCIP 2.0 (Hokuyo, "Communication protocol specification for SCIP
/// 2.0 standard"): lines that end with a line feed, the last one empty. The first echoes the
/// command, the second has a status of two characters and a checksum; further ones have data and
/// a checksum each.
struct ScipResponse {
  std::string echo;                ///< the command with its parameters
  std::string status;              ///< "00": done; "99": a scan of a continuous output
  std::vector<std::string> lines;  ///< data without checksums
  std::int64_t end_us = 0;         ///< arrival of the last line feed, as passed to ScipDecoder::add
  std::size_t bytes = 0;           ///< from the first byte to the last line feed

  [[nodiscard]] bool is_of(std::string_view command) const { return echo.starts_with(command); }
};

/// The checksum of a line: the six low bits of the sum of its characters, as a character.
char scip_checksum(std::string_view line);

/// The number that 1 to 4 characters encode, six bits each, the highest first. Nothing if a
/// character encodes none.
std::optional<std::uint32_t> scip_number(std::string_view characters);

/// Finds the responses in a stream of bytes that may begin anywhere and be damaged. One with a
/// wrong checksum is dropped as a whole. The checksums have six bits only: of damaged lines one in
/// a few hundred passes.
class ScipDecoder {
 public:
  struct Counts {
    std::int64_t responses = 0;
    std::int64_t corrupt = 0;
    std::int64_t garbage_bytes = 0;
  };

  /// Bytes that arrived at this time [µs], the last of them; a byte takes `byte_us` on the line.
  void add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us, double byte_us);

  /// The next complete response.
  std::optional<ScipResponse> next();

  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// Forgets what is not complete, after a change of the baud rate.
  void clear();

 private:
  std::optional<ScipResponse> response_of(std::vector<std::string> lines) const;

  std::string line_;
  std::vector<std::string> lines_;  ///< of the response that is being received
  std::size_t bytes_ = 0;           ///< of it
  std::vector<ScipResponse> responses_;
  std::size_t returned_ = 0;  ///< of them
  Counts counts_;
};

}  // namespace adit
