// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/map_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/bus/log_writer.hpp"
#include "common/config/config.hpp"
#include "tests/replay/map_fixture.hpp"
#include "tools/carmen/carmen_import.hpp"
#include "tools/eval/tum.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Farthest distance between where the trajectory and the truth have the body, both from their
/// first poses.
double farthest_error_m(const Trajectory& trajectory, const Trajectory& truth) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Pose2 found = between(trajectory.front().pose, trajectory[i].pose);
    const Pose2 true_pose = between(truth.front().pose, truth[i].pose);
    farthest = std::max(farthest, between(true_pose, found).translation().norm());
  }
  return farthest;
}

class MapRun : public MapRunTest {
 protected:
  /// What the run says that it fails with; empty if it does not fail.
  std::string failure(const std::filesystem::path& input,
                      const std::filesystem::path& config = {}) const {
    try {
      map(input, "map", Odometry::kUsed, config);
      return {};
    } catch (const std::exception& error) {
      return error.what();
    }
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(at(name), std::ios::binary) << text;
    return at(name);
  }
};

TEST_F(MapRun, FindsTheWayThroughTheMine) {
  constexpr double kLength = 100.0;
  const Trajectory truth = write_sample("sample.lcmlog", kLength);
  for (const Odometry odometry : {Odometry::kUsed, Odometry::kLeftOut}) {
    const MapRunResult result = map(at("sample.lcmlog"), "map", odometry);
    EXPECT_EQ(result.scans, truth.size());
    EXPECT_EQ(result.lost, 0U);
    EXPECT_THAT(result.complaints, IsEmpty());
    EXPECT_NEAR(result.path_length_m, kLength, 0.005 * kLength);

    const Trajectory trajectory = read_tum(at("map/trajectory.tum"));
    ASSERT_EQ(trajectory.size(), truth.size());
    // 0.1 % of the way, and a cell or two of the map; a quarter of it was measured.
    EXPECT_LT(farthest_error_m(trajectory, truth), 0.1);
  }
}

TEST_F(MapRun, SumsUpWhatItDid) {
  const Trajectory truth = write_sample("sample.lcmlog", 20.0);
  map(at("sample.lcmlog"), "map");
  const auto summary = nlohmann::json::parse(contents("map/summary.json"));
  const auto& scans = summary.at("scans");
  EXPECT_EQ(scans.at("total"), truth.size());
  EXPECT_EQ(scans.at("matched"), truth.size() - 1);  // the first has nothing to match
  for (const char* name : {"lost", "refused", "searched", "degenerate"}) {
    EXPECT_GE(scans.at(name), 0) << name;
    EXPECT_LT(scans.at(name), truth.size() / 2) << name;
  }
  EXPECT_NEAR(summary.at("path_length_m"), 20.0, 0.2);
  EXPECT_NEAR(summary.at("duration_s"), 0.2 * static_cast<double>(truth.size() - 1), 1e-6);
  const double wall_s = summary.at("wall_s");
  EXPECT_GT(wall_s, 0.0);
  EXPECT_GT(summary.at("cpu_s"), 0.0);
  EXPECT_NEAR(summary.at("real_time_factor"), summary.at("duration_s").get<double>() / wall_s, 1.0);
  const auto& ms = summary.at("ms_per_scan");
  EXPECT_GT(ms.at("mean"), 0.0);
  EXPECT_GE(ms.at("p99"), ms.at("mean"));
  EXPECT_LT(ms.at("mean").get<double>() * static_cast<double>(truth.size()), 1e3 * wall_s);
  EXPECT_GT(summary.at("peak_memory_mb"), 1.0);
  EXPECT_TRUE(summary.at("unobserved_stretches").is_array());
}

TEST_F(MapRun, WritesAMapAsMapServerReadsIt) {
  write_sample("sample.lcmlog", 20.0);
  map(at("sample.lcmlog"), "map");

  const std::string yaml = contents("map/map.yaml");
  EXPECT_THAT(yaml, HasSubstr("image: map.pgm\n"));
  double resolution_m = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  const char* const shape = "resolution: %lf origin: [%lf, %lf";
  ASSERT_EQ(
      std::sscanf(yaml.substr(yaml.find("resolution")).c_str(), shape, &resolution_m, &x_m, &y_m),
      3);

  std::istringstream pgm(contents("map/map.pgm"));
  std::string magic;
  int columns = 0;
  int rows = 0;
  int shades = 0;
  pgm >> magic >> columns >> rows >> shades;
  pgm.get();
  EXPECT_EQ(magic, "P5");
  EXPECT_EQ(shades, 255);
  std::string cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), ' ');
  ASSERT_TRUE(pgm.read(cells.data(), static_cast<std::streamsize>(cells.size())));
  EXPECT_EQ(pgm.get(), std::char_traits<char>::eof());

  EXPECT_GT(std::count(cells.begin(), cells.end(), '\0'), 100);  // wall
  for (const TimedPose& at : read_tum(at("map/trajectory.tum"))) {
    const int column = static_cast<int>(std::floor((at.pose.x - x_m) / resolution_m));
    const int row = static_cast<int>(std::floor((at.pose.y - y_m) / resolution_m));
    ASSERT_TRUE(column >= 0 && column < columns && row >= 0 && row < rows);
    const auto cell = static_cast<std::size_t>(rows - 1 - row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column);
    EXPECT_EQ(cells[cell], '\xFE') << "the robot drove where the map is not free";
  }
}

TEST_F(MapRun, RefusesBadInputInOneLine) {
  const std::string garbage = "\x01\xED garbage " + std::string(3, '\0') + "\xFF\xFE, no log \n\n";
  write_sample("sample.lcmlog", 2.0);
  const auto good = at("sample.lcmlog");
  const auto cut_off = write("cut.lcmlog", contents("sample.lcmlog").substr(0, 20));
  const std::vector<std::pair<std::string, std::string>> outcomes = {
      {failure(at("missing.log")), "missing.log"},
      {failure(at("missing.lcmlog")), "missing.lcmlog"},
      {failure(at("")), at("").string()},
      {failure(write("empty.log", "")), "empty.log"},
      {failure(write("empty.lcmlog", "")), "empty.lcmlog"},
      {failure(write("garbage.log", garbage)), "garbage.log"},
      {failure(write("garbage.lcmlog", garbage)), "garbage.lcmlog"},
      {failure(cut_off), "cut.lcmlog"},
      {failure(good, at("missing.yaml")), "missing.yaml"},
      {failure(good, write("key.yaml", "scan_matching:\n  lost_scor: 0.5\n")),
       "key.yaml:2: unknown key 'lost_scor'"},
      {failure(good, write("section.yaml", "scan_machting:\n  lost_score: 0.5\n")),
       "section.yaml:1: unknown section 'scan_machting'"},
      {failure(good, write("range.yaml", "scan_matching:\n  lost_score: 5\n")), "range.yaml:2: "}};
  for (const auto& [said, named] : outcomes) {
    EXPECT_THAT(said, HasSubstr(named));
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
  EXPECT_FALSE(std::filesystem::exists(at("map"))) << "nothing is left of runs that failed";
}

TEST_F(MapRun, SaysThatALogHoldsNoScan) {
  LogWriter log(at("no_scan.lcmlog"));
  write_reading(log, WheelOdometry{1'600'000'000'000'000, {}});
  log.close();
  EXPECT_THAT(failure(at("no_scan.lcmlog")), HasSubstr("no usable laser scan in "));
  const auto carmen = write("no_scan.log", "ODOM 0 0 0 0 0 0 5 h 5\n");
  EXPECT_THAT(failure(carmen), HasSubstr("no usable laser scan in "));
  EXPECT_FALSE(std::filesystem::exists(at("map")));
}

TEST_F(MapRun, ARunThatFailsLeavesAnEarlierOneAsItWas) {
  write_sample("sample.lcmlog", 10.0);
  map(at("sample.lcmlog"), "map");
  const std::string record = contents("map/run.lcmlog");
  EXPECT_NE(failure(write("empty.lcmlog", "")), "");
  EXPECT_TRUE(contents("map/run.lcmlog") == record);
  EXPECT_FALSE(std::filesystem::exists(at("map/.unfinished")));
}

TEST_F(MapRun, MayReplaceItsOwnInput) {
  write_sample("sample.lcmlog", 10.0);
  map(at("sample.lcmlog"), "map");
  const std::string record = contents("map/run.lcmlog");
  map(at("map/run.lcmlog"), "map");
  EXPECT_TRUE(contents("map/run.lcmlog") == record);
}

TEST_F(MapRun, ReportsWhatItSkips) {
  write_sample("sample.log", 10.0);
  const std::string good = contents("sample.log");
  const MapRunResult carmen = map(write("bad.log", good + "FLASER 3 1 x 1\n"), "map");
  EXPECT_THAT(carmen.complaints, testing::ElementsAre(HasSubstr("line 64: ")));

  write_sample("sample.lcmlog", 10.0);
  const auto cut_off = write("cut.lcmlog", contents("sample.lcmlog").substr(0, 50'000));
  EXPECT_THAT(map(cut_off, "map").complaints,
              testing::ElementsAre(HasSubstr("the end of the file cuts off")));
}

}  // namespace
}  // namespace adit
