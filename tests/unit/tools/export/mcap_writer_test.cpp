// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/mcap_writer.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

void write(const std::filesystem::path& file, int messages) {
  McapWriter writer(file);
  const auto pose = writer.add_channel("/pose", "json", {"Pose", "jsonschema", "{}"});
  const auto other = writer.add_channel("/other", "json", {"Pose", "jsonschema", "{}"});
  for (int i = 0; i < messages; ++i)
    writer.write(i % 3 == 0 ? other : pose, i, i,
                 std::string(1000, static_cast<char>(i % 90 + 32)));
  writer.close();
}

/// The content is read by an independent reader in tests/live/export.
TEST(McapWriter, GivesTheSameBytesForTheSameMessages) {
  const test::ScratchFolder folder;
  write(folder / "a.mcap", 3000);
  write(folder / "b.mcap", 3000);
  const std::string bytes = test::contents(folder / "a.mcap");
  EXPECT_TRUE(bytes == test::contents(folder / "b.mcap"));
  EXPECT_LT(bytes.size(), 1'000'000U);
  EXPECT_TRUE(bytes.starts_with("\x89MCAP0\r\n"));
  EXPECT_TRUE(bytes.ends_with("\x89MCAP0\r\n"));
}

TEST(McapWriter, HasNoFileBeforeItIsComplete) {
  const test::ScratchFolder folder;
  {
    McapWriter writer(folder / "a.mcap");
    writer.write(writer.add_channel("/pose", "json", {}), 1, 1, "{}");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace adit
