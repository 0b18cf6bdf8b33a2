// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/volume/volume.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/adit/command_result.hpp"
#include "tests/unit/tools/report/embedded_mission.hpp"
#include "tests/unit/tools/report/markup_check.hpp"
#include "tests/unit/tools/report/synthetic_mission_log.hpp"
#include "tools/cloud/cloud_file.hpp"
#include "tools/eval/map_image.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::kMissionUtime;
using test::MissionLogOptions;
using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* kPage = "<!doctype html>\n<html><body></body></html>\n";

class Report : public testing::Test {
 protected:
  MissionReport run(const MissionLogOptions& options = {}) {
    test::write_mission_log(folder_ / "a.lcmlog", options);
    return report({folder_ / "a.lcmlog"});
  }
  MissionReport report(std::vector<fs::path> logs) {
    return write_report({std::move(logs), out(), false, kPage});
  }
  [[nodiscard]] fs::path out() const { return folder_ / "out"; }
  [[nodiscard]] std::string text(const std::string& file) const {
    return test::contents(out() / file);
  }
  [[nodiscard]] test::EmbeddedMission page() const {
    return test::embedded_mission(text("mission.html"));
  }
  [[nodiscard]] json page_summary() const { return json::parse(page().of("/summary").at(0).bytes); }
  [[nodiscard]] json summary() const { return json::parse(text("summary.json")); }

  test::ScratchFolder folder_;
};

TEST_F(Report, ReturnsTheOutcomeOfTheMission) {
  const MissionReport report = run();
  EXPECT_EQ(
      report.outcome,
      "The robot returned home. The exploration is incomplete: 2 of 3 frontiers are closed, 1 "
      "open.");
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_EQ(report.scans, 2U);
  EXPECT_NEAR(report.distance_travelled_m, 20.0, 1e-9);
  EXPECT_EQ(report.page_bytes, fs::file_size(out() / "mission.html"));
}

TEST_F(Report, WritesTheFiguresOfTheMission) {
  run();
  const json statistics = summary();
  EXPECT_EQ(statistics["simulated"], true);
  EXPECT_NEAR(statistics["duration_s"], 51.0, 1e-6);
  EXPECT_NEAR(statistics["max_distance_from_start_m"], 10.0, 1e-9);
  EXPECT_EQ(statistics["mission"]["outcome"], "home");
  EXPECT_EQ(statistics["mission"]["return_home_reason"], test::kHtmlInjection);
  EXPECT_NEAR(statistics["phases"]["by_phase"]["execute"]["duration_s"], 18.0 + 20.0, 1e-6);
  EXPECT_NEAR(statistics["phases"]["by_phase"]["scan"]["share"], 8.0 / 51.0, 1e-6);
  EXPECT_EQ(statistics["scans"], (json{{"taken", 2}, {"without_path", 1}}));
  EXPECT_EQ(statistics["map"]["local_maps"], 4);
  EXPECT_EQ(statistics["map"]["loop_closures"],
            (json{{"proposed", 2}, {"accepted", 1}, {"revised", 1}, {"revoked", 1}}));
  EXPECT_EQ(statistics["guard"]["stops"], 1);
  EXPECT_NEAR(statistics["guard"]["stopped_s"], 2.0, 0.11);  // the step of the orders
  EXPECT_EQ(statistics["restarts"], 1);
  EXPECT_EQ(statistics["collision"], false);
  EXPECT_EQ(statistics["config"]["planning"]["version"], "1.2.3");
  EXPECT_LT(statistics["against_truth"]["rmse_m"], 1e-3);  // after alignment
}

TEST_F(Report, DrawsTheWallsAtTheirPositions) {
  run();
  const auto walls = read_occupied_cells(out() / "map.yaml");
  ASSERT_GT(walls.size(), 500U);
  std::size_t correct = 0;
  for (const Eigen::Vector2d& p_map : walls) {
    if (std::abs(std::abs(p_map.y()) - 2.0) < 0.06) ++correct;  // a cell
  }
  EXPECT_GT(correct, walls.size() * 8 / 10);  // the others are the end of the tunnel
}

TEST_F(Report, WritesReadableFiles) {
  run();
  const G2oGraph graph = read_g2o(out() / "graph.g2o");
  EXPECT_EQ(graph.graph.poses.size(), 4U);
  EXPECT_EQ(graph.graph.constraints.size(), 4U);
  const Trajectory path = read_tum(out() / "trajectory.tum");
  ASSERT_GT(path.size(), 100U);
  EXPECT_NEAR(interpolate(path, kMissionUtime + 25'000'000)->x, 10.0, 1e-6);
  EXPECT_GT(read_cloud_file(out() / "cloud.ply").points.size(), 1000U);
  EXPECT_GT(fs::file_size(out() / "map.png"), 1000U);
  EXPECT_EQ(LogFile(out() / "run.lcmlog").size(), LogFile(folder_ / "a.lcmlog").size());
}

TEST_F(Report, WritesAValidOctree) {
  run();
  const std::string volume = text("volume.bt");
  const std::size_t data = volume.find("\ndata\n");
  ASSERT_NE(data, std::string::npos);
  const OctreeCounts cells = count_cells(
      {reinterpret_cast<const std::uint8_t*>(volume.data()) + data + 6, volume.size() - data - 6});
  EXPECT_EQ(cells.rejection, "");
  EXPECT_GT(cells.occupied, 1000);
  EXPECT_GT(cells.free, cells.occupied);
}

TEST_F(Report, WritesCorridorsInMetres) {
  run();
  const json geo = json::parse(text("junctions.geojson"));
  EXPECT_EQ(geo["type"], "FeatureCollection");
  EXPECT_THAT(geo["crs"]["properties"]["name"].get<std::string>(), StartsWith("ENGCRS["));
  EXPECT_THAT(geo["coordinates_are"].get<std::string>(), HasSubstr("not longitude"));
  ASSERT_EQ(geo["features"].size(), 6U);  // two ends, a corridor, three frontiers
  EXPECT_EQ(geo["features"][2]["geometry"]["coordinates"], (json{{0.0, 0.0}, {15.0, 0.0}}));
  const json& open = geo["features"][3]["properties"];
  EXPECT_EQ(open["state"], "open");
  EXPECT_EQ(open["closed"], false);
  EXPECT_EQ(open["evidence"], test::kHtmlInjection);
}

TEST_F(Report, PutsTheMissionIntoThePageOfTheViewer) {
  run();
  const test::EmbeddedMission mission = page();
  EXPECT_THAT(mission.header["serverInfo"]["metadata"]["title"].get<std::string>(),
              StartsWith("Mission of 2020-09-13"));
  EXPECT_GE(mission.of("/map").size(), 2U);
  EXPECT_GE(mission.of("/mission").size(), 10U);
  const json summary = page_summary();
  EXPECT_THAT(summary["headline"].get<std::string>(), StartsWith("Home; explored"));
  EXPECT_EQ(summary["warnings"], json::array());
  EXPECT_THAT(summary["configuration"].get<std::string>(), HasSubstr("planning"));
}

TEST_F(Report, PutsACardForEachScanIntoThePage) {
  run();
  const auto scans = page().of("/scans");
  ASSERT_EQ(scans.size(), 2U);
  const json with_path = json::parse(scans[0].bytes);
  EXPECT_EQ(with_path["number"], 1);
  EXPECT_EQ(with_path["plans"][0]["outcome"], "path");
  EXPECT_THAT(with_path["plans"][0]["reason"].get<std::string>(), StartsWith("Path of "));
  for (const char* picture : {"terrain", "c_space"}) {
    EXPECT_THAT(with_path["pictures"][picture].get<std::string>(),
                StartsWith("data:image/svg+xml;base64,"));
  }
  EXPECT_THAT(with_path["pictures"]["view"].get<std::string>(),
              StartsWith("data:image/png;base64,"));
  const json without = json::parse(scans[1].bytes);
  EXPECT_NE(without["plans"][0]["outcome"], "path");
  EXPECT_EQ(without["plans"][0]["clearance_m"], nullptr);
}

TEST_F(Report, LeavesThePageOutWhereThereIsNone) {
  test::write_mission_log(folder_ / "a.lcmlog");
  const MissionReport result = write_report({{folder_ / "a.lcmlog"}, out()});
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("no mission.html")));
  EXPECT_FALSE(fs::exists(out() / "mission.html"));
  EXPECT_TRUE(fs::exists(out() / "map.svg"));
}

TEST_F(Report, WritesAWellFormedMapWithLinksToThePage) {
  run();
  EXPECT_THAT(test::markup_errors(text("map.svg")), IsEmpty());
  EXPECT_THAT(test::markup_links(text("map.svg")), Contains("mission.html#scan-2"));
}

TEST_F(Report, EscapesAllTextsOfTheLog) {
  run();
  EXPECT_THAT(text("map.svg"), Not(HasSubstr("<script>alert")));
  EXPECT_THAT(text("map.svg"), HasSubstr("&lt;script&gt;alert(&quot;x&quot;)"));
}

TEST_F(Report, IsReproducible) {
  run();
  write_report({{folder_ / "a.lcmlog"}, folder_ / "again", false, kPage});
  for (const auto& entry : fs::directory_iterator(out())) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(test::contents(entry.path()) == test::contents(folder_ / "again" / name)) << name;
  }
}

TEST_F(Report, InfersPhasesWithoutPhaseMessages) {
  const MissionReport report = run({{"PHASE"}});
  EXPECT_THAT(report.outcome, HasSubstr("The outcome is unknown"));
  EXPECT_THAT(page_summary()["headline"].get<std::string>(), HasSubstr("not in the log"));
  const json statistics = summary();
  EXPECT_EQ(statistics["mission"]["outcome"], nullptr);
  EXPECT_NEAR(statistics["distance_travelled_m"], 20.0,
              0.5);  // two steps of the path, and the turn
  // From SCAN_REQUEST to CLOUD; while DRIVING_STATE is driving.
  EXPECT_NEAR(statistics["phases"]["by_phase"]["scan"]["duration_s"], 7.0, 1e-6);
  EXPECT_NEAR(statistics["phases"]["by_phase"]["execute"]["duration_s"], 18.0 + 20.0, 1e-6);
}

TEST_F(Report, HasNullFiguresWithoutTruth) {
  run({{"TRUTH", "RUN_STATE"}});
  EXPECT_EQ(summary()["simulated"], false);
  EXPECT_EQ(summary()["against_truth"], nullptr);
  EXPECT_EQ(summary()["collision"], nullptr);
}

TEST_F(Report, WarnsOfFilesWithoutData) {
  const MissionReport report =
      run({{"LOCAL_MAP", "POSE_GRAPH", "ASSOCIATION", "CLOUD", "EXPLORATION"}});
  for (const char* warning : {"no map", "no graph.g2o", "no cloud.ply", "no junctions.geojson"}) {
    EXPECT_THAT(report.warnings, Contains(HasSubstr(warning)));
  }
  EXPECT_FALSE(fs::exists(out() / "map.png"));
  EXPECT_FALSE(fs::exists(out() / "cloud.ply"));
  EXPECT_EQ(page_summary()["warnings"].size(), report.warnings.size());
}

TEST_F(Report, WarnsOfMissingLocalMaps) {
  const MissionReport report = run({{}, 15.0});  // the first local map is published at 10 s
  EXPECT_THAT(report.warnings, Contains(HasSubstr("1 local map of the pose graph")));
  EXPECT_EQ(summary()["map"]["local_maps"], 4);
}

/// A recorded CONFIG of another version has keys that this version does not know.
TEST_F(Report, WarnsOfAnUnreadableConfig) {
  test::write_mission_log(folder_ / "a.lcmlog");
  const ConfigSnapshot config{kMissionUtime + 60'000'000, "planning", "0.0.1",
                              "planning:\n  no_such_key: 1\n"};
  LogWriter log(folder_ / "b.lcmlog");
  log.write({config.utime, "CONFIG", encode(to_message(config))});
  log.close();
  const MissionReport report = this->report({folder_ / "a.lcmlog", folder_ / "b.lcmlog"});
  EXPECT_THAT(report.warnings,
              ElementsAre(AllOf(HasSubstr("CONFIG of planning"), HasSubstr("no_such_key"))));
  EXPECT_THAT(page_summary()["warnings"].dump(), HasSubstr("no_such_key"));
}

TEST_F(Report, ReadsATruncatedLog) {
  test::write_mission_log(folder_ / "a.lcmlog");
  fs::resize_file(folder_ / "a.lcmlog", fs::file_size(folder_ / "a.lcmlog") / 2 + 5);
  const MissionReport report = this->report({folder_ / "a.lcmlog"});
  EXPECT_THAT(report.outcome, HasSubstr("in progress"));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("truncated")));
  EXPECT_THAT(page_summary()["headline"].get<std::string>(), HasSubstr("during the mission"));
}

TEST_F(Report, SkipsDamagedMessages) {
  test::write_mission_log(folder_ / "a.lcmlog");
  LogWriter damaged(folder_ / "b.lcmlog");
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5, 6, 7, 8, 9};
  for (int i = 0; i < 3; ++i) damaged.write({kMissionUtime + 60'000'000, "PATH", bytes});
  damaged.close();
  const MissionReport report = this->report({folder_ / "a.lcmlog", folder_ / "b.lcmlog"});
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("3 messages of PATH")));
  EXPECT_EQ(report.scans, 2U);
}

TEST_F(Report, JoinsTheLogsOfOneMission) {
  run();
  const json complete = summary();
  test::write_mission_log(folder_ / "b.lcmlog", {{}, 0.0, 25.0});
  test::write_mission_log(folder_ / "c.lcmlog", {{}, 25.0});
  write_report({{folder_ / "b.lcmlog", folder_ / "c.lcmlog"}, out()});
  EXPECT_EQ(summary(), complete);
  EXPECT_EQ(LogFile(out() / "run.lcmlog").size(), LogFile(folder_ / "a.lcmlog").size());
}

/// lcm-logger --rotate names the newest file first.
TEST_F(Report, ReadsTheLogsByTimeWhateverTheirNames) {
  run();
  const json complete = summary();
  test::write_mission_log(folder_ / "run.lcmlog.1", {{}, 0.0, 25.0});
  test::write_mission_log(folder_ / "run.lcmlog.0", {{}, 25.0});
  std::ofstream(folder_ / "run.lcmlog.2").close();  // killed before its first event
  write_report({{folder_ / "run.lcmlog.0", folder_ / "run.lcmlog.1"}, out()});
  EXPECT_EQ(summary(), complete);
  LogReader log(out() / "run.lcmlog");
  std::int64_t last = 0;
  while (const auto event = log.next()) {
    EXPECT_LE(last, event->utime);
    last = event->utime;
  }
  EXPECT_THAT(
      in_order_of_time(
          {folder_ / "run.lcmlog.2", folder_ / "run.lcmlog.0", folder_ / "run.lcmlog.1"}),
      ElementsAre(folder_ / "run.lcmlog.1", folder_ / "run.lcmlog.0", folder_ / "run.lcmlog.2"));
}

TEST_F(Report, KeepsALogInItsFolder) {
  fs::create_directory(out());
  test::write_mission_log(out() / "run.lcmlog");
  const std::string before = text("run.lcmlog");
  report({out() / "run.lcmlog"});
  EXPECT_TRUE(text("run.lcmlog") == before);
  EXPECT_TRUE(fs::exists(out() / "mission.html"));
}

TEST_F(Report, KeepsSeveralLogsInItsFolder) {
  fs::create_directory(out());
  test::write_mission_log(out() / "run.lcmlog", {{}, 0.0, 25.0});
  test::write_mission_log(out() / "run_2.lcmlog", {{}, 25.0});
  const std::string first = text("run.lcmlog");
  const std::string second = text("run_2.lcmlog");
  write_report({{out() / "run.lcmlog", out() / "run_2.lcmlog"}, out()});
  const json in_folder = summary();
  EXPECT_TRUE(text("run.lcmlog") == first);
  EXPECT_TRUE(text("run_2.lcmlog") == second);
  fs::remove_all(out());
  run();
  EXPECT_EQ(in_folder, summary());
}

TEST_F(Report, RejectsLogsWithoutAMission) {
  std::ofstream(folder_ / "empty.lcmlog").close();
  EXPECT_THROW(write_report({{folder_ / "empty.lcmlog"}, out()}), std::runtime_error);
  EXPECT_THROW(write_report({{folder_ / "none.lcmlog"}, out()}), std::runtime_error);
  EXPECT_THROW(run({{"PHASE", "POSE", "LOCAL_MAP", "CLOUD"}}), std::runtime_error);
  EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

TEST(ReportCommand, PrintsThePathOfThePageAndTheOutcome) {
  const test::ScratchFolder folder;
  test::write_mission_log(folder / "run.lcmlog");
  const CommandResult outcome = adit({"report", folder / "run.lcmlog", "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("The robot returned home."));
}

TEST(ReportCommand, PrintsOneLineForAnEmptyLog) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "empty.lcmlog").close();
  const CommandResult outcome = adit({"report", folder / "empty.lcmlog", "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, MatchesRegex("adit: no events in [^\n]*empty.lcmlog\n"));
}

}  // namespace
}  // namespace adit
