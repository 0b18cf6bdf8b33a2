// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Recovery of a journal with damaged bytes: all intact records remain, in order and once, and the
// damage is counted.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

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
    result.push_back(result.back() + journal_format::write({kind, bytes}, {}).size());
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
      const auto [found, health] = read();
      ASSERT_EQ(found, expected) << at;
      ASSERT_EQ(health.corrupt_regions, 1U) << at;
      ASSERT_EQ(health.corrupt_bytes, limits[std::size_t(hit) + 1] - limits[std::size_t(hit)]);
      ASSERT_EQ(health.first_damage, limits[std::size_t(hit)]);
      ASSERT_EQ(health.missing, hit + 1 < kRecords ? 1U : 0U) << at;
      ASSERT_EQ(health.end_missing, hit + 1 == kRecords) << at;
    }
  }
}

TEST_F(CorruptJournals, KeepTheDamagedFileAndContinueWithAnIntactOne) {
  (void)append(1, 5);
  std::string bytes = contents(path_);
  bytes[ends(5)[2] + 40] ^= 1;
  overwrite(bytes);
  (void)append(6, 7);
  EXPECT_EQ(contents(path_.string() + ".damaged"), bytes);
  Records expected = records(7);
  expected.erase(expected.begin() + 2);
  const auto [found, health] = reopened();
  EXPECT_EQ(found, expected);
  EXPECT_EQ(health.corrupt_regions, 0U);
  EXPECT_EQ(health.missing, 1U) << "the loss stays known";
}

TEST_F(CorruptJournals, ContinueAfterTheDamage) {
  (void)append(1, 5);
  std::string bytes = contents(path_);
  bytes[bytes.size() - 1] ^= 1;
  overwrite(bytes + std::string(5000, '\0'));  // as after a power loss
  const Records added = append(6, 7);
  Records expected = records(4);
  expected.insert(expected.end(), added.begin(), added.end());
  EXPECT_EQ(reopened().first, expected);
}

TEST_F(CorruptJournals, PutSwappedRecordsInOrderAndDropDuplicates) {
  (void)append(1, 5);
  const std::string bytes = contents(path_);
  const auto limits = ends(5);
  const auto part = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    return bytes.substr(limits[k], limits[k + 1] - limits[k]);
  };
  for (const auto& order : std::vector<std::vector<int>>{
           {0, 2, 1, 3, 4}, {0, 1, 2, 2, 3, 4}, {4, 3, 2, 1, 0}, {0, 1, 2, 3, 4, 1}}) {
    std::string changed;
    for (const int i : order) changed += part(i);
    overwrite(changed);
    const auto [found, health] = reopened();
    EXPECT_EQ(found, records(5));
    EXPECT_GT(health.misplaced, 0U);
    EXPECT_TRUE(health.is_damaged());
    EXPECT_FALSE(health.has_loss());
    EXPECT_EQ(reopened().second, (JournalHealth{5})) << "repaired";
  }
}

TEST_F(CorruptJournals, RejectRecordsOfAnotherJournal) {
  Records other;
  {
    Journal journal(path_);
    for (int i = 11; i <= 15; ++i) {
      other.push_back(record(i));
      journal.append(other.back().first, other.back().second);
    }
  }
  const auto size = std::filesystem::file_size(path_);
  const std::string foreign = contents(path_);
  remove();
  (void)append(1, 7);
  overwrite(contents(path_) + foreign.substr(0, size));
  const auto [found, health] = reopened();
  EXPECT_EQ(found, records(7));
  EXPECT_EQ(health.misplaced, 5U);
}

TEST_F(CorruptJournals, CountARemovedRecordAsMissing) {
  (void)append(1, 5);
  const auto limits = ends(5);
  overwrite(contents(path_).erase(limits[1], limits[3] - limits[1]));
  EXPECT_EQ(reopened().second.missing, 2U);
}

TEST_F(CorruptJournals, AcceptAFileOfZeros) {
  overwrite(std::string(4096, '\0'));
  const JournalHealth health = reopened().second;
  EXPECT_EQ(health.corrupt_bytes, 4096U);
  EXPECT_TRUE(health.end_missing);
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

class CopiedJournals : public test::JournalTest {};

TEST_F(CopiedJournals, LoseNothingToAnyDamageOfOneCopy) {
  constexpr int kRecords = 8;
  (void)append(1, kRecords);
  const std::string intact = contents(path_);
  ASSERT_EQ(contents(copy_), intact);
  std::mt19937 random(1);
  const auto at_random = [&] {
    return std::uniform_int_distribution<std::size_t>(0, intact.size() - 1)(random);
  };
  for (int i = 0; i < 120; ++i) {
    std::string bytes = intact;
    const std::size_t at = at_random();
    const std::size_t length = std::min(at_random(), intact.size() - at);
    if (i % 4 == 0) bytes[at] ^= 0x20;
    if (i % 4 == 1) bytes.replace(at, length, length, '\0');
    if (i % 4 == 2) bytes.insert(at_random(), bytes.substr(at, length));
    if (i % 4 == 3) bytes.resize(at);
    const auto& damaged = i % 8 < 4 ? path_ : copy_;
    std::ofstream(damaged, std::ios::binary | std::ios::trunc) << bytes;
    const auto [found, health] = reopened();
    ASSERT_EQ(found, records(kRecords)) << i;
    ASSERT_FALSE(health.has_loss()) << i;
    ASSERT_EQ(text_of(health).empty(), bytes == intact) << i;
    ASSERT_EQ(contents(path_), intact) << i;
    ASSERT_EQ(contents(copy_), intact) << i;
  }
}

TEST_F(CopiedJournals, SayWhatBothCopiesHaveLost) {
  (void)append(1, 8);
  std::string bytes = contents(path_);
  bytes[ends(8)[3] + 30] ^= 1;
  overwrite(bytes);
  std::filesystem::copy_file(path_, copy_, std::filesystem::copy_options::overwrite_existing);
  const auto [found, health] = reopened();
  EXPECT_EQ(found.size(), 7U);
  EXPECT_EQ(health.missing, 1U);
  EXPECT_NE(text_of(health).find("1 record lost"), std::string::npos) << text_of(health);
}

TEST_F(CopiedJournals, AreMadeOfAJournalWithoutACopy) {
  (void)append(1, 4);
  std::filesystem::remove(copy_);
  const auto [found, health] = reopened();
  EXPECT_EQ(found, records(4));
  EXPECT_EQ(text_of(health), "");
  EXPECT_EQ(contents(copy_), contents(path_));
}

TEST_F(CopiedJournals, SurviveTheLossOfAFile) {
  (void)append(1, 4);
  std::filesystem::remove(path_);
  EXPECT_EQ(read_journal(path_, [](const JournalRecord&) {}).records, 4U);
  const auto [found, health] = reopened();
  EXPECT_EQ(found, records(4));
  EXPECT_NE(text_of(health), "");
}

/// A record as release 0.2.0 wrote it.
std::string old_record(int i) {
  const auto [kind, data] = record(i);
  const auto written = journal_format::write({kind, data}, {});
  std::string bytes(written.begin(), written.end());
  bytes[3] = '1';
  std::string header = bytes.substr(0, 16);
  const auto crc = crc32_z(0, reinterpret_cast<const unsigned char*>(header.data()), header.size());
  for (int k = 24; k >= 0; k -= 8) header += static_cast<char>(crc >> k);
  return header + bytes.substr(28);
}

TEST_F(CopiedJournals, ConvertTheOldFormat) {
  std::string old;
  for (int i = 1; i <= 5; ++i) old += old_record(i);
  overwrite(old);
  EXPECT_EQ(reopened(), std::pair(records(5), JournalHealth{5}));
  const std::string converted = contents(path_);
  remove();
  (void)append(1, 5);
  EXPECT_EQ(contents(path_), converted);
}

TEST_F(CopiedJournals, CountDamageInTheOldFormat) {
  std::string old;
  for (int i = 1; i <= 5; ++i) old += old_record(i);
  old[old_record(1).size() + 30] ^= 1;
  overwrite(old);
  const auto [found, health] = reopened();
  EXPECT_EQ(found.size(), 4U);
  EXPECT_EQ(health.missing, 1U);
}

}  // namespace
}  // namespace adit
