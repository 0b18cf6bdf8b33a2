// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A page of a mapped file that cannot be read raises SIGBUS, whatever the reason. Here the file is
// truncated while it is mapped.
#include "common/files/mapped_file.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/files/file_error.hpp"
#include "common/files/file_utils.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));

class MappedFiles : public testing::Test {
 protected:
  fs::path write(const std::string& name, std::size_t bytes) const {
    write_text_file(std::string(bytes, 'x'), folder_ / name);
    return folder_ / name;
  }

  test::ScratchFolder folder_;
};

std::size_t count(std::span<const std::uint8_t> bytes, std::uint8_t value) {
  return static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), value));
}

TEST_F(MappedFiles, AreReadableWithoutErrors) {
  const MappedFile file(write("file", 3 * page + 10));
  EXPECT_EQ(count(file.bytes(), 'x'), 3 * page + 10);
  EXPECT_TRUE(file.is_readable(file.bytes()));
  EXPECT_EQ(file.unreadable_bytes(), 0U);
  EXPECT_NO_THROW(file.require_readable());
}

TEST_F(MappedFiles, HoldZerosWhereTheyCannotBeRead) {
  const fs::path path = write("file", 5 * page);
  const MappedFile file(path);
  fs::resize_file(path, 2 * page);
  EXPECT_EQ(count(file.bytes(), 'x'), 2 * page);
  EXPECT_EQ(count(file.bytes(), 0), 3 * page);
  EXPECT_EQ(file.unreadable_bytes(), 3 * page);
  try {
    file.require_readable();
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(), path.string() + ": the disk cannot read " + std::to_string(3 * page) +
                                " of its " + std::to_string(5 * page) + " bytes");
  }
}

TEST_F(MappedFiles, TellWhichBytesCannotBeRead) {
  const fs::path path = write("file", 4 * page);
  const MappedFile file(path);
  fs::resize_file(path, 2 * page);
  const auto bytes = file.bytes();
  EXPECT_TRUE(file.is_readable(bytes.first(2 * page)));
  EXPECT_TRUE(file.is_readable(bytes.last(0)));
  EXPECT_EQ(file.unreadable_bytes(), 0U);  // of what was accessed
  EXPECT_FALSE(file.is_readable(bytes.subspan(2 * page - 1, 2)));
  EXPECT_FALSE(file.is_readable(bytes.last(1)));
  EXPECT_TRUE(file.is_readable(bytes.first(2 * page)));
  EXPECT_EQ(file.unreadable_bytes(), 2 * page);
}

TEST_F(MappedFiles, AreToldApart) {
  const fs::path path = write("damaged", 2 * page);
  const MappedFile intact(write("intact", 2 * page));
  const MappedFile damaged(path);
  const auto closed = std::make_unique<MappedFile>(write("closed", page));
  fs::resize_file(path, 0);
  EXPECT_EQ(count(damaged.bytes(), 0), 2 * page);
  EXPECT_EQ(intact.unreadable_bytes(), 0U);
  EXPECT_EQ(damaged.unreadable_bytes(), 2 * page);
  const MappedFile next(write("next", page));
  EXPECT_EQ(next.unreadable_bytes(), 0U);
}

TEST_F(MappedFiles, MayBeReadByManyThreads) {
  const fs::path path = write("file", 64 * page);
  const MappedFile file(path);
  fs::resize_file(path, 0);
  std::vector<std::thread> threads;
  std::vector<std::size_t> zeros(4);
  for (std::size_t& sum : zeros) threads.emplace_back([&] { sum = count(file.bytes(), 0); });
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t sum : zeros) EXPECT_EQ(sum, 64 * page);
  EXPECT_EQ(file.unreadable_bytes(), 64 * page);
}

/// Other bus errors end the process as before.
TEST(MappedFilesDeathTest, DoNotHideOtherBusErrors) {
  EXPECT_EXIT(
      {
        const test::ScratchFolder folder;
        write_text_file("x", folder / "file");
        const MappedFile file(folder / "file");
        std::signal(SIGALRM, SIG_DFL);
        alarm(10);
        raise(SIGBUS);
        while (true) pause();
      },
      testing::KilledBySignal(SIGBUS), "");
}

}  // namespace
}  // namespace adit
