// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/journal/journal.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit::test {

/// A copy of a record.
using StoredRecord = std::pair<std::string, std::vector<std::uint8_t>>;
using Records = std::vector<StoredRecord>;

/// Record number i, with length and bytes that depend on i.
inline StoredRecord record(int i) {
  std::vector<std::uint8_t> bytes;
  for (int k = 0; k < (i * 37) % 100; ++k) bytes.push_back(static_cast<std::uint8_t>(i * 31 + k));
  return {i % 2 == 0 ? "LOCAL_MAP" : "ASSOCIATION", bytes};
}

inline Records records(int count) {
  Records result;
  for (int i = 1; i <= count; ++i) result.push_back(record(i));
  return result;
}

/// A test with one journal in its own folder.
class JournalTest : public testing::Test {
 protected:
  [[nodiscard]] Records append(int from, int to) const {
    Records added;
    Journal journal(path_);
    for (int i = from; i <= to; ++i) {
      added.push_back(record(i));
      journal.append(added.back().first, added.back().second);
    }
    return added;
  }

  /// The records in the journal and its integrity on opening.
  std::pair<Records, JournalHealth> reopened() const {
    Records found;
    const Journal journal(path_, [&](const JournalRecord& record) {
      found.emplace_back(record.kind, std::vector(record.bytes.begin(), record.bytes.end()));
    });
    return {found, journal.health()};
  }

  /// The same without opening it, which is faster where it would be repaired.
  std::pair<Records, JournalHealth> read() const {
    Records found;
    const JournalHealth health = read_journal(path_, [&](const JournalRecord& record) {
      found.emplace_back(record.kind, std::vector(record.bytes.begin(), record.bytes.end()));
    });
    return {found, health};
  }

  void remove() const {
    std::filesystem::remove(path_);
    std::filesystem::remove(copy_);
  }

  /// Writes the file, and removes its copy.
  void overwrite(const std::string& bytes) const {
    remove();
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "mission.journal";
  std::filesystem::path copy_ = journal_copy(path_);
};

/// The text of the exception that `action` throws, or nothing.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace adit::test
