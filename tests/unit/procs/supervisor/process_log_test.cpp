// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/process_log.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using test::contents;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::int64_t kUtime = 1'054'290'030'123'456;  // Groundhog's first run in the mine

TEST(ProcessLog, FormatsUtcTime) {
  EXPECT_EQ(utc_text(kUtime), "2003-05-30T10:20:30.123Z");
  EXPECT_EQ(utc_text(0), "1970-01-01T00:00:00.000Z");
}

TEST(ProcessLog, AppendsToAnExistingFile) {
  const test::ScratchFolder folder;
  for (const char* line : {"first", "second"}) {
    ProcessLog log(folder.path(), "mapping", {});
    log.add(line, kUtime);
    log.flush();
  }
  EXPECT_EQ(contents(folder / "mapping.log"),
            "2003-05-30T10:20:30.123Z first\n2003-05-30T10:20:30.123Z second\n");
}

TEST(ProcessLog, WritesNothingWithoutAFolder) {
  ProcessLog log("", "mapping", {});
  log.add("line", kUtime);
  log.flush();
  EXPECT_THAT(log.error(), IsEmpty());
  EXPECT_FALSE(fs::exists("mapping.log"));
}

TEST(ProcessLog, EncodesIdsInUniqueFileNames) {
  const test::ScratchFolder folder;
  for (const char* id : {"..", "a b", "a_b", "\xC3\xA4"}) {
    ProcessLog log(folder.path(), id, {});
    log.add(id, kUtime);
    log.flush();
  }
  for (const char* name : {"%2E%2E.log", "a%20b.log", "a_b.log", "%C3%A4.log"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
}

TEST(RotatedFile, LimitsSizeAndNumberOfFiles) {
  const test::ScratchFolder folder;
  RotatedFile file(folder / "x.log", {100, 3});
  for (int i = 0; i < 100; ++i) file.write("line " + std::to_string(100 + i) + "\n");  // 9 bytes
  EXPECT_THAT(contents(folder / "x.log"), StartsWith("line 199"));  // 11 lines per file
  EXPECT_THAT(contents(folder / "x.log.1"), StartsWith("line 188"));
  EXPECT_THAT(contents(folder / "x.log.2"), StartsWith("line 177"));
  EXPECT_EQ(contents(folder / "x.log.1").size(), 99U);
  EXPECT_FALSE(fs::exists(folder / "x.log.3"));
}

TEST(RotatedFile, CountsExistingContents) {
  const test::ScratchFolder folder;
  RotatedFile(folder / "x.log", {100, 2}).write(std::string(90, 'a'));
  RotatedFile(folder / "x.log", {100, 2}).write(std::string(20, 'b'));
  EXPECT_EQ(contents(folder / "x.log"), std::string(20, 'b'));
  EXPECT_EQ(contents(folder / "x.log.1"), std::string(90, 'a'));
}

TEST(RotatedFile, TruncatesASingleFile) {
  const test::ScratchFolder folder;
  RotatedFile file(folder / "x.log", {100, 1});
  file.write(std::string(90, 'a'));
  file.write(std::string(20, 'b'));
  EXPECT_EQ(contents(folder / "x.log"), std::string(20, 'b'));
}

TEST(RotatedFile, ReportsAWriteErrorAndRecovers) {
  const test::ScratchFolder folder;
  RotatedFile file(folder / "later" / "x.log", {});
  file.write("lost");
  EXPECT_THAT(file.error(), HasSubstr("later/x.log: No such file"));
  fs::create_directory(folder / "later");
  file.write("stored");
  EXPECT_THAT(file.error(), IsEmpty());
  EXPECT_EQ(contents(folder / "later/x.log"), "stored");
}

TEST(RotatedFile, ReportsAFullDisk) {
  RotatedFile file("/dev/full", {});
  file.write("lost");
  EXPECT_THAT(file.error(), HasSubstr("No space left"));
}

}  // namespace
}  // namespace adit
