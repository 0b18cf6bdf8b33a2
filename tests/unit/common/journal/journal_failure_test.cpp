// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Behaviour of a journal with a full disk, an invalid path, or a killed process.
#include <csignal>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/file_size_limit.hpp"
#include "tests/unit/common/journal/journal_fixture.hpp"

namespace adit {
namespace {

using test::error_of;
using test::record;
using test::records;

class FailingJournals : public test::JournalTest {};

TEST_F(FailingJournals, AreUnchangedIfARecordDoesNotFit) {
  Journal journal(path_);
  const auto [kind, bytes] = record(1);
  journal.append(kind, bytes);
  const auto size = std::filesystem::file_size(path_);
  {
    const test::FileSizeLimit limit(size + 30);
    const std::string error = error_of([&] { journal.append("LOCAL_MAP", record(2).second); });
    EXPECT_EQ(error.find(path_.string() + ": cannot write: "), 0U) << error;
    EXPECT_EQ(std::filesystem::file_size(path_), size);
  }
  journal.append(record(2).first, record(2).second);
  std::size_t count = 0;
  EXPECT_EQ(read_journal(path_, [&](const JournalRecord&) { ++count; }),
            (JournalHealth{2, 0, 0, 0}));
  EXPECT_EQ(count, 2U);
}

/// Space in use, including what is reserved.
std::uint64_t used_bytes(const std::filesystem::path& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_blocks) * 512 : 0;
}

TEST_F(FailingJournals, HaveTheirSpaceReservedWhileTheyAreOpen) {
  {
    Journal journal(path_);
    journal.append(record(1).first, record(1).second);
    if (used_bytes(path_) < Journal::kReserveMinBytes)
      GTEST_SKIP() << "the file system cannot reserve space";
    EXPECT_GE(used_bytes(journal_copy(path_)), Journal::kReserveMinBytes);
    EXPECT_LT(std::filesystem::file_size(path_), 1000U);
    EXPECT_FALSE(read_journal(path_, [](const JournalRecord&) {}).is_damaged());
    journal.clear();
    EXPECT_GE(used_bytes(path_), Journal::kReserveMinBytes);
  }
  EXPECT_LT(used_bytes(path_), Journal::kReserveMinBytes);
}

/// After a power loss a file system may have extended the file into the reserved space.
TEST_F(FailingJournals, AreIntactWithZerosBehindTheirEnd) {
  (void)append(1, 3);
  for (const auto& path : {path_, journal_copy(path_)})
    std::filesystem::resize_file(path, std::filesystem::file_size(path) + 5000);
  const JournalHealth health = read_journal(path_, [](const JournalRecord&) {});
  EXPECT_EQ(health.records, 3U);
  EXPECT_FALSE(health.is_damaged()) << text_of(health);
  const Journal journal(path_);
  EXPECT_EQ(journal.damage(), "");
}

TEST_F(FailingJournals, ReportErrorsOfTheirPath) {
  EXPECT_EQ(error_of([] { const Journal journal("/nonexistent/a.journal"); }),
            "/nonexistent/a.journal: cannot open: No such file or directory");
  EXPECT_EQ(error_of([&] { const Journal journal(folder_.path()); }),
            folder_.path().string() + ": cannot open: Is a directory");
  EXPECT_EQ(error_of([] { const Journal journal("/dev/full"); }), "/dev/full: not a regular file");
}

TEST_F(FailingJournals, ReportMissingPermissions) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write every file";
  (void)append(1, 1);
  std::filesystem::permissions(path_, std::filesystem::perms::owner_read);
  EXPECT_EQ(error_of([&] { const Journal journal(path_); }),
            path_.string() + ": cannot open: Permission denied");
}

/// Appends until it is killed, and writes the number of appended records to the pipe.
[[noreturn]] void append_forever(const std::filesystem::path& path, int pipe) {
  try {
    int next = 1;
    Journal journal(path, [&](const JournalRecord&) { ++next; });
    for (;; ++next) {
      const auto [kind, bytes] = record(next);
      journal.append(kind, bytes);
      if (write(pipe, &next, sizeof(next)) != sizeof(next)) std::_Exit(1);
    }
  } catch (const std::exception&) {
    std::_Exit(1);
  }
}

/// The last number in the pipe, 0 if none; reads it to its end.
int last_number(int pipe) {
  int last = 0;
  for (int number = 0; read(pipe, &number, sizeof(number)) == sizeof(number);) last = number;
  return last;
}

/// Kills a child process that appends. Returns the minimum number of records that it had appended.
int append_until_killed(const std::filesystem::path& path, int microseconds) {
  int ends[2];
  if (pipe(ends) != 0) return -1;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    append_forever(path, ends[1]);
  }
  close(ends[1]);
  usleep(static_cast<useconds_t>(microseconds));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  const int appended = last_number(ends[0]);
  close(ends[0]);
  return appended;
}

TEST_F(FailingJournals, KeepAllRecordsOfAKilledProcess) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> microseconds(1000, 8000);
  std::size_t before = 0;
  // On a busy computer a process appends little in so short a time.
  for (int times = 0; times < 40 || (before <= 100 && times < 2000); ++times) {
    const int appended = append_until_killed(path_, microseconds(random));
    const auto [found, health] = reopened();
    ASSERT_GE(found.size(), std::max(before, std::size_t(appended)));
    ASSERT_EQ(health.corrupt_regions, 0U);
    ASSERT_EQ(found, records(static_cast<int>(found.size())));
    before = found.size();
  }
  EXPECT_GT(before, 100U);
}

}  // namespace
}  // namespace adit
