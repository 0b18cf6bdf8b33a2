// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/files/locked_file.hpp"
#include "common/journal/journal_format.hpp"
#include "common/journal/journal_recovery.hpp"

namespace adit {

/// The bytes of a value in memory, for a record. T must have no padding. The bytes depend on the
/// byte order of the computer.
template <class T>
std::array<std::uint8_t, sizeof(T)> bytes_of(const T& value) {
  return std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
}

/// The inverse of bytes_of; nothing if the number of bytes differs from the size of T.
template <class T>
std::optional<T> value_from_bytes(std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, sizeof(T)> read{};
  if (bytes.size() != read.size()) return std::nullopt;
  std::ranges::copy(bytes, read.begin());
  return std::bit_cast<T>(read);
}

/// Called with a record that is valid only during the call.
using JournalReader = std::function<void(const JournalRecord&)>;

/// The second copy of a journal, beside it: for mapping.journal it is mapping.copy.journal, so that
/// who moves or removes all journals does not leave it behind.
std::filesystem::path journal_copy(const std::filesystem::path& path);

/// An append-only file of records, and a copy of it, that survives crashes of the process and the
/// computer, and damage of either file. After
/// `append` a record survives the process; after `sync` it survives the computer. The same records
/// give the same bytes. Space beyond the end is reserved on the disk, as far as its file system
/// can, so that records of together kReserveMinBytes can be appended after the disk became full.
///
/// A disk may fail for one of the files. Records are stored in the other one then, which is
/// reported by `failure`, and the file gets what it lacks as soon as it takes it.
///
/// File errors for which a record is in neither file throw std::runtime_error with one line that
/// begins with the path.
class Journal {
 public:
  static constexpr std::uint64_t kReserveMinBytes = 1'000'000;  ///< for each copy
  static constexpr std::uint64_t kReserveBytes = 2 * kReserveMinBytes;

  /// Opens or creates the journal and passes its records, in order, to the reader. A truncated last
  /// record is removed. A file with other damage is replaced by one with all records of both
  /// copies, and kept as FILE.damaged; so is a file of the format before, which is converted.
  /// Throws if the file is not a journal, which is left unchanged, or if another process has it
  /// open.
  explicit Journal(
      const std::filesystem::path& path, const JournalReader& reader = [](const JournalRecord&) {});
  /// Gives back the space that is reserved and not used.
  ~Journal();
  Journal(Journal&&) noexcept = default;
  Journal& operator=(Journal&&) = delete;

  /// Appends a record. If that fails, e.g. on a full disk, the journal is unchanged and the call
  /// may be repeated. `kind` has 1 to JournalRecord::kKindMax characters.
  void append(std::string_view kind, std::span<const std::uint8_t> bytes);

  /// Removes all records.
  void clear();

  /// Returns when all records are on the disk, in a file at least.
  void sync();

  /// Why the last record is not stored, or not in both files, in one line; empty if it is.
  [[nodiscard]] const std::string& failure() const { return failure_; }

  /// Integrity of the files when they were opened.
  [[nodiscard]] const JournalHealth& health() const { return health_; }
  /// What to tell a person if they were damaged then, in one line: its name and text_of. Empty for
  /// intact ones, and where a power loss explains what is missing.
  [[nodiscard]] const std::string& damage() const { return damage_; }

 private:
  struct Copy {
    std::unique_ptr<LockedFile> file;
    std::uint64_t end = 0;     // of the records in it, which are the first ones of the journal
    std::uint64_t synced = 0;  // end of those that are on the disk
  };

  void repair(Copy& copy, const JournalScan& found,
              const std::vector<JournalScan::Found>& joined) const;
  static void replace(std::unique_ptr<LockedFile>& file,
                      const std::vector<JournalScan::Found>& joined, bool keep);

  bool for_each_copy(const std::function<void(Copy&)>& work);
  void write(Copy& copy, std::span<const std::uint8_t> record) const;
  void catch_up(Copy& copy) const;
  void reserve_ahead();
  void require_space(std::uint64_t end);

  std::vector<Copy> copies_;
  std::string failure_;
  JournalHealth health_;
  std::string damage_;
  journal_format::Place next_;  // of the next record
  std::uint64_t end_ = 0;       // its offset
  std::uint64_t reserved_ = 0;  // end of the reserved space, of each file
};

/// What a stage reports of its journal, or that of its parts, in one line: `error`, why it could
/// not be written last; otherwise why one of its files lacks records. Empty if all is stored twice.
template <class StageJournal>
std::string storage_failure(const std::optional<StageJournal>& journal, const std::string& error) {
  return error.empty() && journal ? journal->failure() : error;
}

/// Whether a line that a stage reports is about its journal.
bool is_about_journal(std::string_view line);

/// Passes the records of a journal and its copy, which may be in use, to the reader without
/// changing the files. Throws like the constructor of Journal, and if the file does not exist.
JournalHealth read_journal(const std::filesystem::path& path, const JournalReader& reader);

/// What to tell a person about a journal when it is opened: its name and text_of; empty for an
/// intact one.
std::string journal_report(const std::filesystem::path& path, const JournalHealth& health);

}  // namespace adit
