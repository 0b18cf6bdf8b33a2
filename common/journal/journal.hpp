// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "common/files/locked_file.hpp"
#include "common/journal/journal_format.hpp"

namespace adit {

/// A value for a record, as it lies in memory: it has no gaps, so that all bytes mean something.
/// The same bits on machines of one byte order.
template <class T>
std::array<std::uint8_t, sizeof(T)> bytes_of(const T& value) {
  return std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
}

/// Nothing where these are not as many bytes as it has.
template <class T>
std::optional<T> value_from_bytes(std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, sizeof(T)> read{};
  if (bytes.size() != read.size()) return std::nullopt;
  std::ranges::copy(bytes, read.begin());
  return std::bit_cast<T>(read);
}

/// Takes a record while it is there; what is to be kept must be copied.
using JournalReader = std::function<void(const JournalRecord&)>;

/// A file to which records are only ever added, so that what was learnt survives: process and
/// computer may die at any moment. After `append` a record survives the process; after `sync` it
/// survives the computer. The same records give the same bytes.
///
/// Whatever goes wrong with the file is a std::runtime_error of one line with its path.
class Journal {
 public:
  /// Opens or creates the journal and gives its records, in the order in which they were added, to
  /// the reader. A last record that is torn is cut off. Damage elsewhere stays as it is and is
  /// passed over. Fails where the file is not a journal, which stays as it is, or where another
  /// process has it open.
  explicit Journal(
      const std::filesystem::path& path, const JournalReader& reader = [](const JournalRecord&) {});

  /// Adds a record. Where that fails, for want of room on the disk say, the journal is as it was
  /// before, and may be tried again. `kind` has 1 to JournalRecord::kKindMax characters.
  void append(std::string_view kind, std::span<const std::uint8_t> bytes);

  /// Forgets all records.
  void clear();

  /// Returns once all records are on the disk.
  void sync() const { file_.sync(); }

  /// What was found when it was opened.
  [[nodiscard]] const JournalHealth& health() const { return health_; }

 private:
  LockedFile file_;
  JournalHealth health_;
  std::uint64_t end_ = 0;  // where the next record goes
};

/// Gives the records of a journal that may be in use to the reader, and changes nothing. Fails as
/// opening it does, and where there is no such file.
JournalHealth read_journal(const std::filesystem::path& path, const JournalReader& reader);

}  // namespace adit
