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

/// What a journal holds, as it lies there: valid as long as the bytes it was read from.
struct JournalRecord {
  static constexpr std::size_t kKindMax = 63;  ///< characters, at least one
  static constexpr std::size_t kBytesMax = 1'000'000'000;

  std::string_view kind;  ///< what the bytes are, e.g. a channel
  std::span<const std::uint8_t> bytes;
};

namespace journal_format {

inline constexpr std::string_view kMagic = "ADJ1";  ///< begins each record
inline constexpr std::size_t kHeadBytes = 20;

/// The record as it goes to the disk. Throws std::length_error for what a record cannot hold.
std::vector<std::uint8_t> write(const JournalRecord& record);

/// Bytes of the record that begins here, head and all, whether they are there or not; nothing where
/// no whole and sound head is.
std::optional<std::size_t> size(std::span<const std::uint8_t> bytes);

/// The record that begins here; nothing where it is not whole and sound.
std::optional<JournalRecord> read(std::span<const std::uint8_t> bytes);

}  // namespace journal_format
}  // namespace adit
