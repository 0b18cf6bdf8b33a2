// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_reader.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/support/recordings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using std::string_literals::operator""s;
using testing::ElementsAre;
using testing::StartsWith;

class CarmenReaderFile : public testing::Test {
 protected:
  const std::filesystem::path& plain(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }

  const std::filesystem::path& compressed(const std::string& text) {
    gzFile file = gzopen(path_.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path_;
  }

  test::ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "carmen.log";
};

std::string odom_lines(int count) {
  std::string text;
  for (int i = 1; i <= count; ++i) {
    text += "ODOM " + std::to_string(i) + " 0 0 0 0 0 " + std::to_string(i) + " h 1\n";
  }
  return text;
}

std::string flaser_line_at(const std::string& time, const std::string& logger_time) {
  return "FLASER 2 1 1 0 0 0 0 0 0 " + time + " h " + logger_time + "\n";
}

int count_records(CarmenReader& reader) {
  int count = 0;
  while (reader.next()) ++count;
  return count;
}

TEST_F(CarmenReaderFile, ReturnsTheOdometryOfAScanBeforeTheScan) {
  CarmenReader reader(plain("NEFF 3\nFLASER 2 1 1 0 0 0 7 8 0.5 2.5 h 1\n"));
  const auto first = reader.next();
  const auto second = reader.next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(std::get<WheelOdometry>(*first).T_wheel_body, (Pose2{7.0, 8.0, 0.5}));
  EXPECT_EQ(std::get<WheelOdometry>(*first).utime, 2500000);
  EXPECT_EQ(std::get<CarmenScan>(*second).scan.utime, 2500000);
  EXPECT_FALSE(reader.next());
}

TEST_F(CarmenReaderFile, ReadsGzipAndPlainText) {
  const std::string text = odom_lines(20000);
  CarmenReader from_plain(plain(text));
  EXPECT_EQ(count_records(from_plain), 20000);
  CarmenReader from_gzip(compressed(text));
  EXPECT_EQ(count_records(from_gzip), 20000);
  EXPECT_DOUBLE_EQ(from_gzip.fraction_read(), 1.0);
}

TEST_F(CarmenReaderFile, ReadsALastLineWithoutLineEnd) {
  CarmenReader reader(plain("ODOM 1 0 0 0 0 0 1 h 1"));
  EXPECT_EQ(count_records(reader), 1);
}

TEST_F(CarmenReaderFile, ReportsTheFirstRejectedLinesPerReason) {
  std::string text = odom_lines(2);
  for (int i = 0; i < 10; ++i) text += "ODOM 0 0 0 0 0 0 0 h 0\n";
  text += "FLASER x\n" + odom_lines(1);
  CarmenReader reader(plain(text));
  EXPECT_EQ(count_records(reader), 3);
  EXPECT_EQ(reader.report().rejected_lines(), 11U);
  EXPECT_THAT(
      reader.report().messages(),
      ElementsAre("lines 3, 4, 5 and 7 more: timestamp not positive", "line 13: malformed number"));
}

TEST_F(CarmenReaderFile, UsesTheTimesOfTheLoggerForScansAndOdometryIfOthersAreCoarse) {
  std::string text;
  for (int i = 1; i <= 20; ++i) {
    text += flaser_line_at("1.01893e+09", std::to_string(i));
    text += "ODOM 1 0 0 0 0 0 1.01893e+09 h " + std::to_string(i) + ".5\n";
  }
  CarmenReader reader(plain(text));
  std::vector<std::int64_t> times;
  while (const auto record = reader.next()) {
    const auto* scan = std::get_if<CarmenScan>(&*record);
    times.push_back(scan != nullptr ? scan->scan.utime : std::get<WheelOdometry>(*record).utime);
  }
  ASSERT_EQ(times.size(), 60U);  // with the odometry in the lines of the scans
  EXPECT_THAT(std::vector(times.begin(), times.begin() + 4),
              ElementsAre(1000000, 1000000, 1500000, 2000000));
  EXPECT_EQ(reader.report().times.source, TimeChoice::Source::kLogged);
  EXPECT_EQ(reader.report().rejected_lines(), 0U);
}

TEST_F(CarmenReaderFile, AssumesTheOrderInTheFileIfAllTimesAreZero) {
  std::string text;
  for (int i = 0; i < 20; ++i) text += flaser_line_at("0", "0");
  CarmenReader reader(plain(text));
  std::int64_t last = 0;
  int scans = 0;
  while (const auto record = reader.next()) {
    const auto* scan = std::get_if<CarmenScan>(&*record);
    if (scan == nullptr) continue;
    EXPECT_GT(scan->scan.utime, last);
    EXPECT_EQ(scan->odometry.utime, scan->scan.utime);
    last = scan->scan.utime;
    ++scans;
  }
  EXPECT_EQ(scans, 20);
  EXPECT_EQ(reader.report().times.source, TimeChoice::Source::kOrder);
}

TEST_F(CarmenReaderFile, RejectsAnOutdatedTimestamp) {
  CarmenReader reader(
      plain("ODOM 1 0 0 0 0 0 100 h 1\nODOM 2 0 0 0 0 0 3.7 h 1\nODOM 3 0 0 0 0 0 99.9 h 1\n"));
  EXPECT_EQ(count_records(reader), 2);
  EXPECT_THAT(reader.report().messages(),
              ElementsAre("line 2: timestamp long before those of the preceding lines"));
}

TEST_F(CarmenReaderFile, RecoversFromATimestampInTheFuture) {
  CarmenReader reader(plain("ODOM 1 0 0 0 0 0 5e9 h 1\n" + odom_lines(5)));
  EXPECT_EQ(count_records(reader), 5);  // the first is lost: only the second one confirms the clock
}

TEST_F(CarmenReaderFile, ReportsATruncatedGzipFile) {
  std::filesystem::resize_file(compressed(odom_lines(20000)), 30000);
  CarmenReader reader(path_);
  EXPECT_GT(count_records(reader), 100);
  EXPECT_THAT(reader.report().messages().back(),
              StartsWith("the last 0 of 30000 bytes of the compressed file, which is damaged"));
}

TEST_F(CarmenReaderFile, SkipsAnOverlongLine) {
  CarmenReader reader(plain("FLASER 9 " + std::string(5U << 20U, '1') + "\n" + odom_lines(1)));
  EXPECT_EQ(count_records(reader), 1);
  EXPECT_THAT(reader.report().messages(), ElementsAre("line 1: line longer than 1 MiB"));
}

TEST_F(CarmenReaderFile, IgnoresBinaryData) {
  CarmenReader reader(plain("\xff\x01 FLASER\0\n\n\nODOM \0 1\n"s));
  EXPECT_EQ(count_records(reader), 0);
}

TEST(CarmenReader, RejectsAMissingFile) {
  EXPECT_THROW(CarmenReader{"/nonexistent.log"}, std::runtime_error);
  EXPECT_THROW(CarmenReader{testing::TempDir()}, std::runtime_error);
}

TEST(CarmenReader, ReadsTheRecordings) {
  const std::tuple<const char*, std::size_t, std::size_t> expected[] = {
      {"laser2d/intel_raw.log.gz", 2726, 0},
      {"laser2d/csail_raw.log.gz", 1988, 0},
      {"laser2d/fr079_chain.log.gz", 1464, 0},
      {"laser2d/acapulco_scans.log.gz", 861, 861},
      {"laser2d/seattle_scans.log.gz", 241, 241}};
  for (const auto& [name, scans, rejected] : expected) {
    ADIT_RECORDING_OR_SKIP(path, name);
    CarmenReader reader(path);
    count_records(reader);
    EXPECT_EQ(reader.report().scans, scans) << name;
    EXPECT_EQ(reader.report().rejected_lines(), rejected) << name;
  }
}

}  // namespace
}  // namespace adit
