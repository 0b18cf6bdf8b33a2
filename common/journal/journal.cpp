// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/journal/journal.hpp"

#include <stdexcept>
#include <vector>

#include "common/files/mapped_file.hpp"

namespace adit {
namespace {

/// Removes a partially written record. If that fails too, the next record overwrites it, and any
/// remaining bytes are skipped when the journal is read.
void discard_partial_record(const LockedFile& file, std::uint64_t end) {
  try {
    file.truncate(end);
  } catch (const std::runtime_error&) {  // NOLINT(bugprone-empty-catch): report the first error
  }
}

}  // namespace

JournalHealth read_journal(const std::filesystem::path& path, const JournalReader& reader) {
  const MappedFile file(path);
  JournalParser parser(file.bytes());
  while (const auto record = parser.next()) reader(*record);
  if (parser.health().records == 0 && !may_be_journal(file.bytes())) {
    throw std::runtime_error(path.string() + ": not a journal");
  }
  return parser.health();
}

Journal::Journal(const std::filesystem::path& path, const JournalReader& reader)
    : file_(path),
      health_(read_journal(path, reader)),
      end_(file_.size() - health_.truncated_bytes) {
  if (health_.truncated_bytes > 0) file_.truncate(end_);
  if (end_ == 0) file_.sync_folder();
}

void Journal::append(std::string_view kind, std::span<const std::uint8_t> bytes) {
  const std::vector<std::uint8_t> record = journal_format::write({kind, bytes});
  try {
    file_.write_at(end_, record);
  } catch (const std::runtime_error&) {
    discard_partial_record(file_, end_);
    throw;
  }
  end_ += record.size();
}

void Journal::clear() {
  file_.truncate(0);
  end_ = 0;
}

}  // namespace adit
