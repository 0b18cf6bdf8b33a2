// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Behaviour of a journal when the disk fails for one of its files; failing_disk.cpp fails the
// calls.
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/unit/common/journal/journal_fixture.hpp"

namespace adit {
namespace {

using test::error_of;
using test::record;
using test::records;

std::string bytes_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Calls fail for files whose path begins so, during the lifetime of this.
class FailingDisk {
 public:
  FailingDisk(const std::filesystem::path& below, const char* call) {
    setenv("FAIL_BELOW", below.c_str(), 1);
    setenv("FAIL_CALL", call, 1);
    setenv("FAIL_AFTER", "0", 1);
  }
  FailingDisk(const FailingDisk&) = delete;
  FailingDisk& operator=(const FailingDisk&) = delete;
  ~FailingDisk() { unsetenv("FAIL_BELOW"); }
};

enum class File { kFirst, kCopy };

class JournalsOnAFailingDisk : public test::JournalTest, public testing::WithParamInterface<File> {
 protected:
  [[nodiscard]] std::filesystem::path failing() const {
    return GetParam() == File::kFirst ? path_ : copy_;
  }
  static void add(Journal& journal, int i) { journal.append(record(i).first, record(i).second); }
  void expect_intact(int count) const {
    EXPECT_EQ(bytes_in(path_), bytes_in(copy_));
    const auto [found, health] = read();
    EXPECT_EQ(found, records(count));
    EXPECT_FALSE(health.is_damaged());
  }
};

TEST_P(JournalsOnAFailingDisk, StoreInTheOtherFile) {
  {
    Journal journal(path_);
    add(journal, 1);
    const FailingDisk disk(failing(), "write");
    for (int i = 2; i <= 5; ++i) add(journal, i);
    journal.sync();
    EXPECT_EQ(journal.failure(), failing().string() + ": cannot write: Input/output error");
    EXPECT_EQ(read().first, records(5));
  }
  EXPECT_NE(bytes_in(path_), bytes_in(copy_));
  EXPECT_EQ(reopened().first, records(5));
  expect_intact(5);
}

TEST_P(JournalsOnAFailingDisk, WriteWhatAFileLacksOnceItTakesIt) {
  Journal journal(path_);
  {
    const FailingDisk disk(failing(), "write");
    for (int i = 1; i <= 4; ++i) add(journal, i);
  }
  add(journal, 5);
  EXPECT_EQ(journal.failure(), "");
  expect_intact(5);
}

TEST_P(JournalsOnAFailingDisk, WriteAgainWhatMayNotBeOnTheDisk) {
  Journal journal(path_);
  add(journal, 1);
  journal.sync();
  add(journal, 2);
  {
    const FailingDisk disk(failing(), "fsync");
    journal.sync();
    EXPECT_EQ(journal.failure(), failing().string() + ": cannot sync: Input/output error");
  }
  add(journal, 3);
  journal.sync();
  EXPECT_EQ(journal.failure(), "");
  expect_intact(3);
}

TEST_P(JournalsOnAFailingDisk, OpenWithAFileThatLacksRecords) {
  (void)append(1, 3);
  std::filesystem::resize_file(failing(), 0);
  {
    const FailingDisk disk(failing(), "write");
    Journal journal(path_);
    EXPECT_EQ(journal.failure(), failing().string() + ": cannot write: Input/output error");
    add(journal, 4);
    EXPECT_EQ(read().first, records(4));
  }
  EXPECT_EQ(reopened().first, records(4));
  expect_intact(4);
}

TEST_P(JournalsOnAFailingDisk, LeaveWhatAFileHasThatCannotBeCompleted) {
  (void)append(1, 3);
  const std::string all = bytes_in(path_);
  std::filesystem::resize_file(failing(), all.size() - record(3).second.size() - 1);
  {
    const FailingDisk disk(failing(), "write");
    const Journal journal(path_);
  }
  const std::string left = bytes_in(failing());
  EXPECT_GT(left.size(), 0U);
  EXPECT_EQ(all.compare(0, left.size(), left), 0);
}

INSTANTIATE_TEST_SUITE_P(Files, JournalsOnAFailingDisk, testing::Values(File::kFirst, File::kCopy),
                         [](const auto& file) {
                           return file.param == File::kFirst ? "First" : "Copy";
                         });

using CompletelyFailingDisk = test::JournalTest;

TEST_F(CompletelyFailingDisk, LeavesTheJournalUnchanged) {
  Journal journal(path_);
  journal.append(record(1).first, record(1).second);
  {
    const FailingDisk disk(folder_.path(), "write");
    const auto store = [&] { journal.append(record(2).first, record(2).second); };
    const std::string error = path_.string() + ": cannot write: Input/output error";
    EXPECT_EQ(error_of(store), error);
    EXPECT_EQ(error_of(store), error);
    EXPECT_EQ(journal.failure(), error);
  }
  EXPECT_EQ(read().first, records(1));
  journal.append(record(2).first, record(2).second);
  EXPECT_EQ(journal.failure(), "");
  EXPECT_EQ(read().first, records(2));
  EXPECT_EQ(bytes_in(path_), bytes_in(copy_));
}

TEST_F(CompletelyFailingDisk, LosesTheEarlierRecordsOfAClearedJournalOnly) {
  Journal journal(path_);
  for (int i = 11; i <= 15; ++i) journal.append(record(i).first, record(i).second);
  journal.clear();
  {
    const FailingDisk disk(copy_, "write");
    journal.append(record(1).first, record(1).second);
  }
  journal.append(record(2).first, record(2).second);
  EXPECT_EQ(read().first, records(2));
  EXPECT_EQ(bytes_in(path_), bytes_in(copy_));
}

}  // namespace
}  // namespace adit
