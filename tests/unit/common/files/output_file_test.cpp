// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/output_file.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "common/files/disk_space.hpp"
#include "common/files/file_error.hpp"
#include "common/files/file_utils.hpp"
#include "common/files/locked_file.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

TEST(OutputFile, EndsWhereItEndedBeforeAWriteThatFailed) {
  const test::ScratchFolder folder;
  const std::filesystem::path path = folder / "file";
  OutputFile file(path);
  file.write("complete");
  {
    const test::FileSizeLimit limit(12);
    EXPECT_THROW(file.write(std::string(100, 'x')), FileError);
  }
  EXPECT_EQ(read_text_file(path), "complete");
  file.write(", again");
  file.close();
  EXPECT_EQ(read_text_file(path), "complete, again");
}

TEST(OutputFile, NamesTheFileAndTheReason) {
  OutputFile full("/dev/full", "picture.png");
  try {
    full.write("x");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "picture.png: cannot write: No space left on device");
  }
}

TEST(DiskSpace, IsShortBelowTheMinimumAlone) {
  const test::ScratchFolder folder;
  ASSERT_GT(free_bytes(folder.path()), 0U);
  EXPECT_EQ(DiskSpace(folder.path(), 0.0).shortage(), "");
  const std::string shortage = DiskSpace(folder.path(), 1e12).shortage();
  EXPECT_NE(shortage.find(" MB free on the disk of " + folder.path().string()), std::string::npos)
      << shortage;
}

TEST(DiskSpace, IsNotShortWhereTheSystemDoesNotTell) {
  EXPECT_EQ(free_bytes("/no/such/folder"), std::nullopt);
  EXPECT_EQ(DiskSpace("/no/such/folder", 1e12).shortage(), "");
}

TEST(LockedFile, ReservesSpaceWithoutChangingTheFile) {
  const test::ScratchFolder folder;
  const LockedFile file(folder / "file");
  if (file.reserve(0, 1'000'000) != LockedFile::Reservation::kDone)
    GTEST_SKIP() << "the file system cannot reserve space";
  EXPECT_EQ(file.size(), 0U);
}

}  // namespace
}  // namespace adit
