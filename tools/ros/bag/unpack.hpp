// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace adit {

/// How the chunks of a bag are compressed.
enum class Compression : std::uint8_t { kNone, kBz2, kLz4, kZstd };

/// By its name in ROS 1 bags ("none", "bz2", "lz4") and in MCAP ("", "lz4", "zstd").
std::optional<Compression> compression_of(std::string_view name);

struct Unpacked {
  std::vector<std::uint8_t> bytes;
  bool whole = true;  ///< false: the content ends early, behind damage or a truncation
};

/// Decompresses a content of `size` bytes: bzip2, an LZ4 frame or zstd. Of damaged input the
/// beginning, as far as it can be decompressed; no more than `size` bytes, and no more memory than
/// the content takes.
Unpacked unpack(Compression compression, std::span<const std::uint8_t> packed, std::size_t size);

}  // namespace adit
