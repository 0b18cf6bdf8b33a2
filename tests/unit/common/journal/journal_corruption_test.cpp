// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Recovery of a journal with damaged bytes: all intact records remain.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/common/journal/journal_fixture.hpp"

namespace adit {
namespace {

using test::contents;
using test::error_of;
using test::record;
using test::Records;
using test::records;

/// Sizes of the journal after 0 to `count` records.
std::vector<std::size_t> ends(int count) {
  std::vector<std::size_t> result = {0};
  for (const auto& [kind, bytes] : records(count)) {
    result.push_back(result.back() + journal_format::write({kind, bytes}).size());
  }
  return result;
}

class CorruptJournals : public test::JournalTest {};

TEST_F(CorruptJournals, RemoveALastRecordTruncatedAtAnyByte) {
  constexpr int kRecords = 5;
  (void)append(1, kRecords);
  const std::string complete = contents(path_);
  const std::size_t start = ends(kRecords)[kRecords - 1];
  for (std::size_t size = start; size < complete.size(); ++size) {
    overwrite(complete.substr(0, size));
    const auto [found, health] = reopened();
    ASSERT_EQ(found, records(kRecords - 1)) << size;
    ASSERT_EQ(health, (JournalHealth{kRecords - 1, 0, 0, size - start})) << size;
    ASSERT_EQ(std::filesystem::file_size(path_), start);
  }
}

TEST_F(CorruptJournals, RemoveATruncatedFirstRecord) {
  (void)append(1, 1);
  const std::string complete = contents(path_);
  for (std::size_t size = 0; size < complete.size(); ++size) {
    overwrite(complete.substr(0, size));
    ASSERT_EQ(reopened().second, (JournalHealth{0, 0, 0, size}));
    (void)append(1, 1);
    ASSERT_EQ(reopened().first, records(1));
  }
}

TEST_F(CorruptJournals, SkipOnlyTheRecordWithAChangedByte) {
  constexpr int kRecords = 5;
  (void)append(1, kRecords);
  const std::string complete = contents(path_);
  const auto limits = ends(kRecords);
  for (std::size_t at = 0; at < complete.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      std::string bytes = complete;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      overwrite(bytes);
      Records expected = records(kRecords);
      const auto hit = std::upper_bound(limits.begin(), limits.end(), at) - limits.begin() - 1;
      expected.erase(expected.begin() + hit);
      const auto [found, health] = reopened();
      ASSERT_EQ(found, expected) << at;
      ASSERT_EQ(health.corrupt_regions, 1U) << at;
      ASSERT_EQ(health.corrupt_bytes, limits[std::size_t(hit) + 1] - limits[std::size_t(hit)]);
      ASSERT_EQ(contents(path_), bytes) << "reading does not modify a damaged file";
    }
  }
}

TEST_F(CorruptJournals, ContinueAfterTheDamage) {
  (void)append(1, 5);
  std::string bytes = contents(path_);
  bytes[bytes.size() - 1] ^= 1;
  overwrite(bytes + std::string(5000, '\0'));  // as after a power loss
  const Records added = append(6, 7);
  Records expected = records(4);
  expected.insert(expected.end(), added.begin(), added.end());
  const auto [found, health] = reopened();
  EXPECT_EQ(found, expected);
  EXPECT_EQ(health.corrupt_regions, 1U);
}

TEST_F(CorruptJournals, AcceptAFileOfZeros) {
  overwrite(std::string(4096, '\0'));
  EXPECT_EQ(reopened().second, (JournalHealth{0, 1, 4096, 0}));
  EXPECT_EQ(append(1, 2), records(2));
  EXPECT_EQ(reopened().first, records(2));
}

TEST_F(CorruptJournals, RejectFilesThatAreNotJournals) {
  for (const std::string text : {"# A list of things that nobody wants to lose\n", "x", "ADx"}) {
    overwrite(text);
    EXPECT_EQ(error_of([&] { const Journal journal(path_); }), path_.string() + ": not a journal");
    EXPECT_EQ(contents(path_), text);
  }
}

}  // namespace
}  // namespace adit
