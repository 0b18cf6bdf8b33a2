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

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/config/config.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "procs/mapping/map_journal.hpp"
#include "tests/replay/map_fixture.hpp"
#include "tools/carmen/carmen_import.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Writes a drive through the mine without its first scans; returns the true trajectory.
Trajectory write_rest(std::size_t scans_before, const std::filesystem::path& path) {
  SampleRun run;
  for (std::size_t i = 0; i < scans_before; ++i) run.next();
  write_sample_log(run, path);
  return {run.truth().begin() + static_cast<std::ptrdiff_t>(scans_before), run.truth().end()};
}

/// Maximum position error, with the first poses aligned.
double max_error_m(const Trajectory& trajectory, const Trajectory& truth) {
  double error_max_m = 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Pose2 estimated = between(trajectory.front().pose, trajectory[i].pose);
    const Pose2 true_pose = between(truth.front().pose, truth[i].pose);
    error_max_m = std::max(error_max_m, between(true_pose, estimated).translation().norm());
  }
  return error_max_m;
}

class MapRun : public MapRunTest {
 protected:
  /// Error of the run; empty on success.
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

TEST_F(MapRun, EstimatesTheTrajectoryThroughTheMine) {
  constexpr double kLength = 100.0;
  const Trajectory truth = write_sample("sample.lcmlog", kLength);
  for (const Odometry odometry : {Odometry::kUsed, Odometry::kIgnored}) {
    const MapRunResult result = map(at("sample.lcmlog"), "map", odometry);
    EXPECT_EQ(result.scans, truth.size());
    EXPECT_EQ(result.lost, 0U);
    EXPECT_THAT(result.warnings, IsEmpty());
    EXPECT_NEAR(result.path_length_m, kLength, 0.005 * kLength);

    const Trajectory trajectory = read_tum(at("map/trajectory.tum"));
    ASSERT_EQ(trajectory.size(), truth.size());
    // 0.1 % of the path length, and one or two cells; a quarter of this is measured.
    EXPECT_LT(max_error_m(trajectory, truth), 0.1);
  }
}

TEST_F(MapRun, WritesASummary) {
  const Trajectory truth = write_sample("sample.lcmlog", 20.0);
  map(at("sample.lcmlog"), "map");
  const auto summary = nlohmann::json::parse(contents("map/summary.json"));
  const auto& scans = summary.at("scans");
  EXPECT_EQ(scans.at("total"), truth.size());
  EXPECT_EQ(scans.at("matched"), truth.size() - 1);  // the first scan has no reference
  for (const char* name : {"lost", "rejected", "searched", "degenerate"}) {
    EXPECT_GE(scans.at(name), 0) << name;
    EXPECT_LT(scans.at(name), truth.size() / 2) << name;
  }
  EXPECT_NEAR(summary.at("path_length_m"), 20.0, 0.36);  // a scan apart, and kTravelStepM
  EXPECT_NEAR(summary.at("duration_s"), 0.32 * static_cast<double>(truth.size() - 1), 1e-5);
  const double wall_s = summary.at("wall_s");
  EXPECT_GT(wall_s, 0.0);
  EXPECT_GT(summary.at("cpu_s"), 0.0);
  EXPECT_NEAR(summary.at("real_time_factor"), summary.at("duration_s").get<double>() / wall_s, 1.0);
  const auto& ms = summary.at("ms_per_scan");
  EXPECT_GT(ms.at("mean"), 0.0);
  EXPECT_GE(ms.at("p99"), ms.at("mean"));
  EXPECT_LT(ms.at("mean").get<double>() * static_cast<double>(truth.size()), 1e3 * wall_s);
  EXPECT_GT(summary.at("peak_memory_mb"), 1.0);
  EXPECT_TRUE(summary.at("unobserved_segments").is_array());
}

TEST_F(MapRun, WritesAMapForMapServer) {
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

TEST_F(MapRun, ClosesTheLoopsOfTheMine) {
  const Trajectory truth = write_sample("sample.lcmlog", 1000.0);  // the complete drive
  const MapRunResult result = map(at("sample.lcmlog"), "map");
  EXPECT_GT(result.local_maps, 80U);  // one each 5 m
  EXPECT_GT(result.loop_closures, 20U);
  EXPECT_LT(max_error_m(read_tum(at("map/trajectory.tum")), truth), 0.15);  // 3 cells

  const auto summary = nlohmann::json::parse(contents("map/summary.json"));
  const auto& found = summary.at("map");
  EXPECT_EQ(found.at("sessions"), 1);
  EXPECT_EQ(found.at("local_maps"), result.local_maps);
  EXPECT_EQ(found.at("loop_closures").at("accepted"), result.loop_closures);
  EXPECT_GE(found.at("loop_closures").at("proposed"), result.loop_closures);
  EXPECT_GE(found.at("objective"), 0.0);
  EXPECT_GT(found.at("bytes_per_local_map").at("serialised"), 1000);
  EXPECT_GT(found.at("bytes_per_local_map").at("resident"), 1000);
  EXPECT_GT(summary.at("ms_per_local_map").at("mean"), 0.0);
  EXPECT_GE(summary.at("ms_per_local_map").at("max"), summary.at("ms_per_local_map").at("mean"));

  const G2oGraph graph = read_g2o(at("map/graph.g2o"));
  EXPECT_EQ(graph.graph.poses.size(), result.local_maps);
  EXPECT_EQ(graph.graph.constraints.size(), result.local_maps - 1 + result.loop_closures);
  const std::string table = contents("map/associations.tsv");
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), static_cast<long>(result.loop_closures));
  const StoredMap journal = read_map_journal(at("map/map.journal"));
  EXPECT_EQ(journal.maps.size(), result.local_maps);
}

TEST_F(MapRun, ResumesTheMapOfAnEarlierRun) {
  constexpr double kHalf = 240.0;  // of 449 m; around the ring
  const Trajectory first = write_sample("first.lcmlog", kHalf);
  const Trajectory second = write_rest(first.size(), at("second.lcmlog"));
  map(at("first.lcmlog"), "first");
  const std::size_t poses_before = read_tum(at("first/trajectory.tum")).size();
  const MapRunResult result = resume(at("second.lcmlog"), "both", "first");
  EXPECT_THAT(result.warnings, IsEmpty());
  EXPECT_GT(result.local_maps, 80U);
  EXPECT_GT(result.cross_session_loop_closures, 5U);

  const Trajectory path = read_tum(at("both/trajectory.tum"));
  EXPECT_GT(path.size(), second.size());
  EXPECT_EQ(path.back().utime, second.back().utime);
  EXPECT_EQ(path.front().utime, first.front().utime);
  double farthest_m = 0.0;
  Trajectory truth = first;
  truth.insert(truth.end(), second.begin(), second.end());
  for (const TimedPose& at : path) {
    const Pose2 true_pose = between(truth.front().pose, *interpolate(truth, at.utime));
    farthest_m = std::max(farthest_m, between(true_pose, at.pose).translation().norm());
  }
  EXPECT_LT(farthest_m, 0.3);
  EXPECT_EQ(read_tum(at("both/odometry.tum")).size(), second.size());
  EXPECT_EQ(nlohmann::json::parse(contents("both/summary.json")).at("map").at("sessions"), 2);

  // Resuming in place gives the same result; the earlier run was not modified.
  EXPECT_EQ(read_tum(at("first/trajectory.tum")).size(), poses_before);
  resume(at("second.lcmlog"), "first", "first");
  for (const std::string name : {"/trajectory.tum", "/map.journal", "/map.png"}) {
    EXPECT_TRUE(contents("first" + name) == contents("both" + name)) << name;
  }
}

TEST_F(MapRun, ReportsWhyItCannotResume) {
  write_sample("sample.lcmlog", 20.0);
  write_sample("short.lcmlog", 2.0);
  map(at("sample.lcmlog"), "first");
  map(at("short.lcmlog"), "short");
  const auto failure_of = [&](const std::string& input, const std::string& earlier) -> std::string {
    try {
      resume(at(input), "map", earlier);
      return {};
    } catch (const std::exception& error) {
      return error.what();
    }
  };
  EXPECT_EQ(failure_of("sample.lcmlog", "nowhere"),
            "no map to resume: " + at("nowhere/map.journal").string() + " does not exist");
  EXPECT_THAT(failure_of("sample.lcmlog", "short"), HasSubstr("no local map in "));
  EXPECT_THAT(failure_of("short.lcmlog", "first"), HasSubstr("too short to continue a map: "));
  write("first/map.journal", "garbage");
  write("first/map.copy.journal", "garbage");
  EXPECT_THAT(failure_of("sample.lcmlog", "first"), HasSubstr("map.journal"));
  EXPECT_FALSE(std::filesystem::exists(at("map")));
}

TEST_F(MapRun, TheRecordedConfigurationHasNoAbsolutePath) {
  write_sample("sample.lcmlog", 10.0);
  map(at("sample.lcmlog"), "map");
  const std::string log = contents("map/run.lcmlog");
  EXPECT_THAT(log, HasSubstr("journal: \"map.journal\""));
  EXPECT_EQ(log.find(at("map").string()), std::string::npos);
}

TEST_F(MapRun, BothStagesUseTheSameLaserPoses) {
  write_sample("sample.lcmlog", 60.0);
  map(at("sample.lcmlog"), "default");
  const auto turned =
      write("turned.yaml", "lasers:\n  front:\n    T_body_laser: {theta_rad: 1.5707963}\n");
  map(at("sample.lcmlog"), "turned", Odometry::kIgnored, turned);
  const auto loop_closures = [&](const std::string& folder) {
    return nlohmann::json::parse(
        contents(folder + "/summary.json"))["map"]["loop_closures"]["accepted"];
  };
  // The body frame differs, but the walls coincide as before.
  EXPECT_GE(loop_closures("turned"), 1);
  EXPECT_GE(loop_closures("default"), 1);
  EXPECT_THAT(failure(at("sample.lcmlog"),
                      write("old.yaml", "scan_matching:\n  laser_front: {range_min_m: 1}\n")),
              HasSubstr("old.yaml:2: unknown key 'laser_front'"));
}

TEST_F(MapRun, LaserPosesComeFromTheConfigurationElseFromTheLog) {
  write_sample("sample.lcmlog", 20.0);
  const auto ahead = write("ahead.yaml", "lasers:\n  front:\n    T_body_laser: {x_m: 1.5}\n");
  map(at("sample.lcmlog"), "ahead", Odometry::kUsed, ahead);
  map(at("ahead/run.lcmlog"), "replayed");
  EXPECT_EQ(contents("replayed/trajectory.tum"), contents("ahead/trajectory.tum"));

  const auto back = write("back.yaml", "lasers:\n  front:\n    T_body_laser: {x_m: 0}\n");
  map(at("sample.lcmlog"), "plain");
  map(at("ahead/run.lcmlog"), "back", Odometry::kUsed, back);
  EXPECT_EQ(contents("back/trajectory.tum"), contents("plain/trajectory.tum"));
  EXPECT_NE(contents("plain/trajectory.tum"), contents("ahead/trajectory.tum"));
}

TEST_F(MapRun, RejectsBadInputInOneLine) {
  const std::string garbage = "\x01\xED garbage " + std::string(3, '\0') + "\xFF\xFE, no log \n\n";
  write_sample("sample.lcmlog", 2.0);
  const auto good = at("sample.lcmlog");
  const auto truncated = write("truncated.lcmlog", contents("sample.lcmlog").substr(0, 20));
  const std::vector<std::pair<std::string, std::string>> outcomes = {
      {failure(at("missing.log")), "missing.log"},
      {failure(at("missing.lcmlog")), "missing.lcmlog"},
      {failure(at("")), at("").string()},
      {failure(write("empty.log", "")), "empty.log"},
      {failure(write("empty.lcmlog", "")), "empty.lcmlog"},
      {failure(write("garbage.log", garbage)), "garbage.log"},
      {failure(write("garbage.lcmlog", garbage)), "garbage.lcmlog"},
      {failure(truncated), "truncated.lcmlog"},
      {failure(good, at("missing.yaml")), "missing.yaml"},
      {failure(good, write("key.yaml", "scan_matching:\n  lost_scor: 0.5\n")),
       "key.yaml:2: unknown key 'lost_scor'"},
      {failure(good, write("section.yaml", "scan_machting:\n  lost_score: 0.5\n")),
       "section.yaml:1: unknown section 'scan_machting'"},
      {failure(good, write("range.yaml", "scan_matching:\n  lost_score: 5\n")), "range.yaml:2: "}};
  for (const auto& [error, expected] : outcomes) {
    EXPECT_THAT(error, HasSubstr(expected));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  EXPECT_FALSE(std::filesystem::exists(at("map"))) << "a failed run leaves no output";
}

TEST_F(MapRun, ReportsALogWithoutScans) {
  LogWriter log(at("no_scan.lcmlog"));
  write_reading(log, WheelOdometry{1'600'000'000'000'000, {}});
  log.close();
  EXPECT_THAT(failure(at("no_scan.lcmlog")), HasSubstr("no usable laser scan in "));
  const auto carmen = write("no_scan.log", "ODOM 0 0 0 0 0 0 5 h 5\n");
  EXPECT_THAT(failure(carmen), HasSubstr("no usable laser scan in "));
  EXPECT_FALSE(std::filesystem::exists(at("map")));
}

TEST_F(MapRun, UsesTheTimesOfTheLoggerIfAllMessagesHaveTimeZero) {
  const Trajectory truth = write_sample("sample.lcmlog", 20.0);
  LogWriter writer(at("zero.lcmlog"));
  LogReader reader(at("sample.lcmlog"));
  while (const auto event = reader.next()) {
    std::vector<std::uint8_t> bytes(event->data.begin(), event->data.end());
    std::fill_n(bytes.begin() + 8, 8, 0);  // utime, after the fingerprint
    writer.write({event->utime, event->channel, bytes});
  }
  writer.close();
  const MapRunResult result = map(at("zero.lcmlog"), "map");
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("times of the logger are used: ")));
  const Trajectory trajectory = read_tum(at("map/trajectory.tum"));
  ASSERT_EQ(trajectory.size(), truth.size());
  EXPECT_LT(max_error_m(trajectory, truth), 0.1);  // as with the times of measurement
  const auto summary = nlohmann::json::parse(contents("map/summary.json"));
  EXPECT_EQ(summary.at("times").at("source"), "logger");
}

TEST_F(MapRun, SaysWhyNextToNothingOfALogIsUsable) {
  write_sample("sample.log", 1.0);
  std::string text = contents("sample.log");
  for (int i = 0; i < 1000; ++i) text += "FLASER 3 1 x 1\n";
  const std::string error = failure(write("bad.log", text));
  EXPECT_THAT(error, HasSubstr("too few usable laser scans in "));
  EXPECT_THAT(error, HasSubstr("malformed number"));
  EXPECT_EQ(error.find('\n'), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(at("map")));
}

TEST_F(MapRun, AFailedRunKeepsTheEarlierOutput) {
  write_sample("sample.lcmlog", 10.0);
  map(at("sample.lcmlog"), "map");
  const std::string log = contents("map/run.lcmlog");
  EXPECT_NE(failure(write("empty.lcmlog", "")), "");
  EXPECT_TRUE(contents("map/run.lcmlog") == log);
  EXPECT_FALSE(std::filesystem::exists(at("map/.unfinished")));
}

TEST_F(MapRun, CanOverwriteItsInput) {
  write_sample("sample.lcmlog", 10.0);
  map(at("sample.lcmlog"), "map");
  const std::string log = contents("map/run.lcmlog");
  map(at("map/run.lcmlog"), "map");
  EXPECT_TRUE(contents("map/run.lcmlog") == log);
}

TEST_F(MapRun, ReportsSkippedInput) {
  write_sample("sample.log", 10.0);
  const std::string good = contents("sample.log");
  const MapRunResult carmen = map(write("bad.log", good + "FLASER 3 1 x 1\n"), "map");
  const auto lines = std::count(good.begin(), good.end(), '\n');
  EXPECT_THAT(carmen.warnings,
              testing::ElementsAre(HasSubstr("line " + std::to_string(lines + 1) + ": ")));

  write_sample("sample.lcmlog", 10.0);
  const auto truncated = write("truncated.lcmlog", contents("sample.lcmlog").substr(0, 50'000));
  EXPECT_THAT(map(truncated, "map").warnings,
              testing::ElementsAre(HasSubstr("the last event, which is truncated")));
}

}  // namespace
}  // namespace adit
