// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tests/unit/common/journal/journal_fixture.hpp"

namespace adit {
namespace {

using test::contents;
using test::error_of;
using test::records;

TEST(JournalRecord, HasTheBytesOfTheReadme) {
  const std::vector<std::uint8_t> data = {1, 2, 3};
  const auto bytes = journal_format::write({"POSE", data}, {5, 6});
  ASSERT_EQ(bytes.size(), 35U);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 4), "ADJ2");
  EXPECT_EQ(bytes[7], 4);
  EXPECT_EQ(bytes[11], 3);
  EXPECT_EQ(bytes[19], 5);
  EXPECT_EQ(bytes[23], 6);
  EXPECT_EQ(std::string(bytes.begin() + 28, bytes.begin() + 32), "POSE");
  EXPECT_EQ(bytes.back(), 3);
}

TEST(JournalRecord, RejectsAnEmptyOrOverlongKind) {
  EXPECT_THROW(journal_format::write({"", {}}, {}), std::length_error);
  EXPECT_THROW(journal_format::write({std::string(64, 'x'), {}}, {}), std::length_error);
  EXPECT_NO_THROW(journal_format::write({std::string(63, 'x'), {}}, {}));
}

class Journals : public test::JournalTest {};

TEST_F(Journals, ReturnAppendedRecordsInOrder) {
  EXPECT_EQ(append(1, 20), records(20));
  EXPECT_EQ(reopened().first, records(20));
  EXPECT_EQ(reopened().second, (JournalHealth{20, 0, 0, 0}));
}

TEST_F(Journals, ContinueAnExistingFile) {
  (void)append(1, 3);
  (void)append(4, 9);
  EXPECT_EQ(reopened().first, records(9));
}

TEST_F(Journals, AreReproducible) {
  (void)append(1, 20);
  const std::string first = contents(path_);
  remove();
  for (int i = 1; i <= 20; ++i) (void)append(i, i);
  EXPECT_EQ(contents(path_), first);
}

TEST_F(Journals, MayBeEmpty) {
  EXPECT_EQ(reopened().second, JournalHealth{});
  EXPECT_TRUE(std::filesystem::exists(path_));
  EXPECT_EQ(reopened().second, JournalHealth{});
}

TEST_F(Journals, AreOpenedExclusively) {
  const Journal first(path_);
  EXPECT_EQ(error_of([&] { const Journal second(path_); }),
            path_.string() + ": in use by another process");
}

TEST_F(Journals, CanBeReadWhileTheyAreWritten) {
  Journal journal(path_);
  journal.append("POSE", {});
  journal.sync();
  std::size_t count = 0;
  EXPECT_EQ(read_journal(path_, [&](const JournalRecord&) { ++count; }).records, 1U);
  EXPECT_EQ(count, 1U);
}

TEST_F(Journals, ThrowOnReadingAMissingFileAndDoNotCreateIt) {
  EXPECT_NE(error_of([&] { read_journal(path_, [](const JournalRecord&) {}); }), "");
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(Journals, HoldLargeRecords) {
  const std::vector<std::uint8_t> large(20'000'000, 7);
  Journal(path_).append("LOCAL_MAP", large);
  EXPECT_EQ(reopened().first.at(0).second, large);
}

}  // namespace
}  // namespace adit
