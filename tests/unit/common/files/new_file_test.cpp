// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/new_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "common/files/file_utils.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(NewFile, HasItsNameOnceItIsPublished) {
  const test::ScratchFolder folder;
  const fs::path path = fs::path(folder / "new.txt");
  NewFile file(path);
  std::ofstream(file.part()) << "complete";
  EXPECT_FALSE(fs::exists(path));
  file.publish();
  EXPECT_EQ(read_text_file(path), "complete");
  EXPECT_EQ(files_in(path.parent_path()), 1U);
}

TEST(NewFile, LeavesTheOldFileIfItIsNotPublished) {
  const test::ScratchFolder folder;
  const fs::path path = fs::path(folder / "file.txt");
  write_text_file("old", path);
  { std::ofstream(NewFile(path).part()) << "ha"; }
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(files_in(path.parent_path()), 1U);
}

TEST(NewFile, KeepsThePermissionsAndTheTargetOfALink) {
  const test::ScratchFolder folder;
  const fs::path path = fs::path(folder / "file.txt");
  write_text_file("old", path);
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("file.txt", folder / "link.txt");
  write_text_file("new", folder / "link.txt");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(read_text_file(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(NewFile, WritesADeviceDirectly) {
  write_text_file("text", "/dev/null");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THROW(write_text_file("text", "/dev/full"), std::runtime_error);
}

TEST(WriteTextFile, LeavesNothingOnAFullDisk) {
  const test::ScratchFolder folder;
  const fs::path path = fs::path(folder / "file.txt");
  write_text_file("old", path);
  {
    const test::FileSizeLimit limit(1000);
    EXPECT_THROW(write_text_file(std::string(100'000, 'x'), path), std::runtime_error);
  }
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(files_in(path.parent_path()), 1U);
}

TEST(ReadTextFile, BoundsTheSize) {
  const test::ScratchFolder folder;
  write_text_file(std::string(1000, 'x'), folder / "file.txt");
  EXPECT_EQ(read_text_file(folder / "file.txt", 1000).size(), 1000U);
  EXPECT_THROW(read_text_file(folder / "file.txt", 999), std::runtime_error);
  EXPECT_THROW(read_text_file("/dev/zero", 1'000'000), std::runtime_error);
  EXPECT_THROW(read_text_file(testing::TempDir()), std::runtime_error);
  EXPECT_THROW(read_gzip_file("/dev/zero", 1'000'000), std::runtime_error);
}

}  // namespace
}  // namespace adit
