// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include "foxglove.pb.h"

#include "common/bus/channels.hpp"
#include "common/geometry/attitude.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "tests/unit/viewer/scene_fixture.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A scan of 181 beams from a laser in the middle of a straight tunnel along x, of half a width.
LaserScan tunnel_scan(std::int64_t utime, double half_width_m) {
  LaserScan scan{.utime = utime,
                 .ranges_m = {},
                 .angle_min_rad = -0.5 * std::numbers::pi,
                 .angle_step_rad = std::numbers::pi / 180.0};
  for (int i = 0; i <= 180; ++i) {
    const double across = std::abs(std::sin(scan.angle_min_rad + i * scan.angle_step_rad));
    scan.ranges_m.push_back(across < 0.25 ? 0.0F : static_cast<float>(half_width_m / across));
  }
  return scan;
}

/// A local map of scans every 0.5 m over 5 m of a straight tunnel.
LocalMap tunnel_map(int id, std::int64_t utime, const Pose2& T_odom_local, double half_width_m) {
  LocalMap map;
  map.id = id;
  map.utime = utime;
  map.end_utime = utime + 10'000'000;
  map.T_odom_local = T_odom_local;
  map.information = Eigen::Matrix3d::Identity();
  for (int i = 0; i <= 10; ++i) {
    LocalScan scan;
    scan.channel = channels::kLaserFront;
    scan.scan = tunnel_scan(utime + 1'000'000 * i, half_width_m);
    scan.T_local_body = {0.5 * i, 0.0, 0.0};
    map.scans.push_back(scan);
  }
  return map;
}

MapGraph graph_of(std::int64_t utime, const std::vector<Pose2>& poses) {
  MapGraph graph;
  graph.utime = utime;
  graph.revision = static_cast<std::int64_t>(utime % 1000) + 1;
  graph.poses = poses;
  graph.z_m.assign(poses.size(), 0.0);
  graph.z_variance.assign(poses.size(), 0.01);
  return graph;
}

/// Occupancy and coverage of a cell of /map; occupancy 255 outside.
struct GridCell {
  int occupancy = 255;
  int coverage = 0;
};
GridCell cell_at(const foxglove::Grid& grid, double x, double y) {
  const auto& corner = grid.pose().position();
  const int column = static_cast<int>(std::floor((x - corner.x()) / grid.cell_size().x()));
  const int row = static_cast<int>(std::floor((y - corner.y()) / grid.cell_size().y()));
  const int rows = static_cast<int>(grid.data().size() / grid.row_stride());
  if (column < 0 || row < 0 || row >= rows || column >= static_cast<int>(grid.column_count()))
    return {};
  const std::size_t at = static_cast<std::size_t>(row) * grid.row_stride() +
                         static_cast<std::size_t>(column) * grid.cell_stride();
  return {static_cast<unsigned char>(grid.data()[at + 4]),
          static_cast<unsigned char>(grid.data()[at + 5])};
}

using SceneTest = SceneFixture;

TEST_F(SceneTest, AdvertisesSchemasWithAllImports) {
  for (const Topic& topic : board_.topics()) {
    if (topic.encoding == "json") {
      EXPECT_EQ(topic.schema_encoding, "jsonschema") << topic.name;
      continue;
    }
    EXPECT_EQ(topic.schema_encoding, "protobuf");
    EXPECT_EQ(topic.schema.find_first_not_of(
                  "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/="),
              std::string::npos);
    EXPECT_TRUE(topic.schema_name.starts_with("foxglove.")) << topic.name;
  }
  std::vector<std::string> names;
  for (const Topic& topic : board_.topics()) names.push_back(topic.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre(
                         "/tf", "/pose", "/laser/front", "/laser/rear", "/map", "/cloud", "/volume",
                         "/trajectory", "/path", "/graph", "/frontiers", "/hazards", "/uncertainty",
                         "/mission", "/processes", "/events", "/scans", "/history"));
}

TEST_F(SceneTest, SaysNothingBeforeMessagesArrive) {
  for (const Topic& topic : board_.topics()) EXPECT_EQ(newest(topic.name), "") << topic.name;
}

TEST_F(SceneTest, PlacesTheRobotInMap) {
  MapCorrection correction;
  correction.utime = kStartUs;
  correction.T_map_odom = {1.0, -2.0, 0.3};
  correction.z_map_odom_m = 0.5;
  send(channels::kMapCorrection, correction);
  const StampedPose pose{.utime = kStartUs + 5,
                         .T_odom_body = {10.0, 4.0, -0.7},
                         .v_body = {},
                         .z_m = 0.25,
                         .attitude = {.roll_rad = 0.05, .pitch_rad = -0.1}};
  send(channels::kPose, pose);

  const Eigen::Isometry3d expected =
      in_space(correction.T_map_odom, 0.5) * in_space(pose.T_odom_body, 0.25, pose.attitude);
  const auto message = newest_of<foxglove::PoseInFrame>("/pose");
  EXPECT_EQ(message.frame_id(), "map");
  EXPECT_EQ(1'000'000 * message.timestamp().seconds() + message.timestamp().nanos() / 1000,
            pose.utime);
  EXPECT_NEAR(message.pose().position().x(), expected.translation().x(), 1e-9);
  EXPECT_NEAR(message.pose().position().y(), expected.translation().y(), 1e-9);
  EXPECT_NEAR(message.pose().position().z(), expected.translation().z(), 1e-9);
  const Eigen::Quaterniond q(expected.linear());
  const auto& sent = message.pose().orientation();
  EXPECT_NEAR(std::abs(q.dot(Eigen::Quaterniond(sent.w(), sent.x(), sent.y(), sent.z()))), 1.0,
              1e-9);

  const auto tf = newest_of<foxglove::FrameTransforms>("/tf");
  std::vector<std::string> frames;
  for (const auto& transform : tf.transforms())
    frames.push_back(transform.parent_frame_id() + ">" + transform.child_frame_id());
  EXPECT_THAT(frames, ElementsAre("map>odom", "odom>body", "body>laser_front", "body>laser_rear"));
}

TEST_F(SceneTest, SendsLaserScansAsTheyAre) {
  LaserScan scan = tunnel_scan(kStartUs, 2.0);
  scan.ranges_m[7] = 81.91F;  // no return
  send(channels::kLaserRear, scan);
  const auto message = newest_of<foxglove::LaserScan>("/laser/rear");
  EXPECT_EQ(message.frame_id(), "laser_rear");
  ASSERT_EQ(message.ranges_size(), 181);
  EXPECT_NEAR(message.start_angle(), scan.angle_min_rad, 1e-6);  // float in the message
  EXPECT_NEAR(message.end_angle(), 0.5 * std::numbers::pi, 1e-4);
  EXPECT_EQ(message.ranges(0), scan.ranges_m[0]);
  EXPECT_EQ(message.ranges(7), 0.0);
  EXPECT_EQ(newest("/laser/front"), "");
}

TEST_F(SceneTest, DrawsWallsWhereTheyAre) {
  send_object(channels::kLocalMap, tunnel_map(0, kStartUs, {}, 2.0));
  EXPECT_EQ(newest("/map"), "") << "no pose of the local map is known";
  send_object(channels::kPoseGraph, graph_of(kStartUs, {{0.0, 0.0, 0.0}}));
  const auto grid = newest_of<foxglove::Grid>("/map");
  EXPECT_GE(cell_at(grid, 2.5, 2.0).occupancy, 65);
  EXPECT_GE(cell_at(grid, 2.5, -2.0).occupancy, 65);
  EXPECT_LT(cell_at(grid, 2.5, 0.05).occupancy, 10);
  EXPECT_EQ(cell_at(grid, 2.5, 0.05).coverage, 1) << "seen by the laser only";
  EXPECT_EQ(cell_at(grid, 2.5, 2.6).occupancy, 255);
  EXPECT_EQ(cell_at(grid, 2.5, 2.6).coverage, 0);
}

TEST_F(SceneTest, MovesTheMapWithThePoseGraph) {
  send_object(channels::kLocalMap, tunnel_map(0, kStartUs, {}, 2.0));
  send_object(channels::kPoseGraph, graph_of(kStartUs, {{0.0, 0.0, 0.0}}));
  newest("/map");
  // Turned to the left by a right angle and moved: the tunnel runs along y at x = 10.
  send_object(channels::kPoseGraph, graph_of(kStartUs + 1, {{10.0, 0.0, 0.5 * std::numbers::pi}}));
  const auto grid = newest_of<foxglove::Grid>("/map");
  EXPECT_GE(cell_at(grid, 8.0, 2.55).occupancy, 65);
  EXPECT_GE(cell_at(grid, 12.0, 2.55).occupancy, 65);
  EXPECT_LT(cell_at(grid, 10.0, 2.55).occupancy, 10);
  EXPECT_EQ(cell_at(grid, 2.5, 2.0).occupancy, 255);
}

TEST_F(SceneTest, DrawsScansThatAreNotInALocalMapYet) {
  for (int i = 0; i <= 20; ++i) {
    const std::int64_t utime = kStartUs + 100'000 * i;
    send(channels::kLaserFront, tunnel_scan(utime, 2.0));
    ScanMatch match;
    match.utime = utime;
    match.reference_utime = kStartUs - 1;
    match.odom_epoch_utime = kStartUs - 1;
    match.channel = channels::kLaserFront;
    match.status = ScanMatch::Status::kMatched;
    match.T_odom_body = {0.1 * i, 0.0, 0.0};
    send(channels::kScanMatch, match);
  }
  const auto grid = newest_of<foxglove::Grid>("/map");
  EXPECT_GE(cell_at(grid, 2.0, 2.0).occupancy, 65);
  EXPECT_LT(cell_at(grid, 2.0, 0.05).occupancy, 10);
}

TEST_F(SceneTest, MarksWhatWasDrivenAndScanned) {
  send_object(channels::kLocalMap, tunnel_map(0, kStartUs, {}, 2.0));
  send_object(channels::kPoseGraph, graph_of(kStartUs, {{0.0, 0.0, 0.0}}));
  TerrainMap terrain;
  terrain.utime = kStartUs;
  terrain.id = 1;
  terrain.cell_m = 0.1;
  terrain.p_level_corner = {0.0, -1.5};
  terrain.cells = Grid2<TerrainCell>(30, 30);
  for (TerrainCell& cell : terrain.cells) cell.ground = Ground::kObserved;
  send_object(channels::kTerrain, terrain);
  for (int i = 0; i <= 20; ++i) {
    send(channels::kPose,
         StampedPose{
             .utime = kStartUs + 100'000 * i, .T_odom_body = {0.1 * i, 0.0, 0.0}, .v_body = {}});
  }
  const auto grid = newest_of<foxglove::Grid>("/map");
  EXPECT_EQ(cell_at(grid, 1.5, 0.05).coverage, 3);
  EXPECT_EQ(cell_at(grid, 1.5, 1.25).coverage, 2);
  EXPECT_EQ(cell_at(grid, 4.5, 0.05).coverage, 1);
}

TEST_F(SceneTest, SendsThePathDrivenAndTheOnePlanned) {
  for (int i = 0; i <= 40; ++i) {
    if (i == 20) {
      MissionPhase phase;
      phase.utime = kStartUs + 100'000 * i;
      phase.sequence = 2;
      phase.returning_home = true;
      send(channels::kPhase, phase);
    }
    send(channels::kPose,
         StampedPose{
             .utime = kStartUs + 100'000 * i, .T_odom_body = {0.2 * i, 0.0, 0.0}, .v_body = {}});
  }
  const auto trajectory = newest_of<foxglove::SceneUpdate>("/trajectory");
  ASSERT_EQ(trajectory.entities_size(), 2);
  EXPECT_EQ(trajectory.entities(0).id(), "outbound");
  EXPECT_EQ(trajectory.entities(1).id(), "return");
  const auto& home = trajectory.entities(1).lines(0);
  EXPECT_NEAR(home.points(0).x(), 3.8, 1e-9) << "begins where the other one ends";
  EXPECT_NEAR(home.points(home.points_size() - 1).x(), 8.0, 1e-9);

  PlannedPath path;
  path.utime = kStartUs;
  path.id = 3;
  path.outcome = PlanOutcome::kFound;
  path.points = {{.T_odom_body = {1.0, 2.0, 0.0}}, {.T_odom_body = {4.0, 2.0, 0.0}}};
  send(channels::kPath, path);
  const auto planned = newest_of<foxglove::SceneUpdate>("/path");
  ASSERT_EQ(planned.entities_size(), 1);
  EXPECT_NEAR(planned.entities(0).lines(0).points(1).x(), 4.0, 1e-9);
  path.outcome = PlanOutcome::kBlocked;
  path.points.clear();
  send(channels::kPath, path);
  EXPECT_EQ(newest_of<foxglove::SceneUpdate>("/path").entities_size(), 0);
}

TEST_F(SceneTest, DrawsTheGraphWithRevokedLoopClosures) {
  MapGraph graph = graph_of(kStartUs, {{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
  const auto constraint = [](int from, int to, MapConstraint::Kind kind) {
    MapConstraint result;
    result.measured.from = from;
    result.measured.to = to;
    result.measured.information = Eigen::Matrix3d::Identity();
    result.kind = kind;
    return result;
  };
  graph.constraints = {constraint(0, 1, MapConstraint::Kind::kSequential),
                       constraint(1, 2, MapConstraint::Kind::kSequential),
                       constraint(0, 2, MapConstraint::Kind::kLoopClosure)};
  send_object(channels::kPoseGraph, graph);
  Association association;
  association.utime = kStartUs;
  association.action = Association::Action::kRevised;
  association.loop_closure.id = 4;
  association.loop_closure.newer_map = 2;
  association.loop_closure.alternatives = {{.older_map = 1, .T_older_newer = {}}};
  association.loop_closure.alternatives[0].information = Eigen::Matrix3d::Identity();
  association.previously_chosen = 0;
  association.chosen = Association::kNone;
  association.reason = "the map is inconsistent";
  send(channels::kAssociation, association);

  const auto update = newest_of<foxglove::SceneUpdate>("/graph");
  std::map<std::string, int> points;
  for (const auto& entity : update.entities()) {
    if (entity.lines_size() > 0) points[entity.id()] = entity.lines(0).points_size();
  }
  EXPECT_THAT(points, ElementsAre(testing::Pair("loop closures", 2), testing::Pair("revoked", 2),
                                  testing::Pair("sequential", 4)));
  ASSERT_EQ(update.entities(3).id(), "local maps");
  EXPECT_EQ(update.entities(3).texts_size(), 3);
  EXPECT_NEAR(update.entities(3).texts(1).pose().position().x(), 5.0, 1e-9);

  foxglove::Log event;
  ASSERT_TRUE(event.ParseFromString(newest("/events")));
  EXPECT_THAT(event.message(), HasSubstr("revoked: the map is inconsistent"));

  association.chosen = 0;
  send(channels::kAssociation, association);
  const auto later = newest_of<foxglove::SceneUpdate>("/graph");
  for (const auto& entity : later.entities()) {
    if (entity.id() == "revoked") {
      EXPECT_EQ(entity.lines(0).points_size(), 0);
    }
  }
}

TEST_F(SceneTest, NamesStateAndEvidenceOfFrontiers) {
  ExplorationReport report;
  report.utime = kStartUs;
  Frontier frontier;
  frontier.id = 7;
  frontier.p_map = {12.0, 3.0};
  frontier.direction_map = {0.0, 1.0};
  frontier.width_m = 2.25;
  frontier.state = FrontierState::kTooNarrow;
  frontier.utime = kStartUs;
  frontier.evidence = "0.62 m wide";
  report.frontiers = {frontier};
  send(channels::kExploration, report);
  const auto update = newest_of<foxglove::SceneUpdate>("/frontiers");
  ASSERT_EQ(update.entities_size(), 1);
  const auto& entity = update.entities(0);
  EXPECT_EQ(entity.id(), "frontier 7");
  std::map<std::string, std::string> metadata;
  for (const auto& pair : entity.metadata()) metadata[pair.key()] = pair.value();
  EXPECT_EQ(metadata["state"], "too narrow");
  EXPECT_EQ(metadata["evidence"], "0.62 m wide");
  EXPECT_EQ(metadata["width_m"], "2.25");
  EXPECT_NEAR(entity.arrows(0).pose().position().x(), 12.0, 1e-6);
  EXPECT_NEAR(entity.arrows(0).pose().orientation().z(), std::sin(std::numbers::pi / 4.0), 1e-6);
  EXPECT_EQ(newest_json("/mission")["frontiers"]["too narrow"], 1);
}

TEST_F(SceneTest, JoinsObservationsOfOneHazard) {
  send(channels::kPose,
       StampedPose{.utime = kStartUs, .T_odom_body = {5.0, 0.0, 0.0}, .v_body = {}});
  PlannedPath path;
  path.utime = kStartUs;
  path.outcome = PlanOutcome::kBlocked;
  for (int i = 0; i < 10; ++i) {
    path.blocking.push_back({.p_odom = {8.0, 0.1 * i},
                             .reason = BlockingCell::Reason::kStep,
                             .height_m = 0.3 + 0.01 * i});
  }
  path.blocking.push_back(
      {.p_odom = {8.0, 0.0}, .reason = BlockingCell::Reason::kSlope, .height_m = 0.2});
  send(channels::kPath, path);
  send(channels::kGas, GasReading{.utime = kStartUs, .methane_share = 0.013});
  send(channels::kGas, GasReading{.utime = kStartUs + 1, .methane_share = 0.012});
  send(channels::kSinkage, SinkageReading{.utime = kStartUs, .depth_m = {0.0, 0.12, 0.0, 0.0}});

  std::map<std::string, std::string> values;
  const auto hazards = newest_of<foxglove::SceneUpdate>("/hazards");
  for (const auto& entity : hazards.entities()) {
    std::map<std::string, std::string> metadata;
    for (const auto& pair : entity.metadata()) metadata[pair.key()] = pair.value();
    values[metadata["kind"]] = metadata["value"] + metadata["unit"];
    if (metadata["kind"] == "step") {
      EXPECT_NEAR(entity.cubes(0).pose().position().y(), 0.45, 1e-9);
      EXPECT_NEAR(entity.cubes(0).size().y(), 1.0, 1e-9);
    }
  }
  EXPECT_THAT(values, ElementsAre(testing::Pair("methane", "1.30%"), testing::Pair("mud", "0.12m"),
                                  testing::Pair("slope", "0.20m"), testing::Pair("step", "0.39m")));
}

/// A scan of a floor at z = 0 and a roof at z = 2.
Cloud floor_and_roof(std::int64_t utime, int id) {
  Cloud cloud;
  cloud.utime = utime;
  cloud.id = id;
  cloud.T_odom_level = {3.0, 0.0, 0.0};
  CloudLine line;
  line.utime = utime;
  for (int i = 0; i < 100; ++i) {
    const float x = 0.05F * static_cast<float>(i) + 0.01F;
    line.points.emplace_back(x, 0.01F, 0.01F);
    line.points.emplace_back(x, 0.01F, 2.01F);
  }
  cloud.lines = {line};
  return cloud;
}

TEST_F(SceneTest, ThinsScansToAVolumeWithClearance) {
  send_object(channels::kCloud, floor_and_roof(kStartUs, 5));
  TerrainMap terrain;
  terrain.utime = kStartUs;
  terrain.id = 5;
  terrain.T_odom_level = {3.0, 0.0, 0.0};
  terrain.cells = Grid2<TerrainCell>(10, 1);  // the first metre
  for (TerrainCell& cell : terrain.cells) {
    cell.ground = Ground::kObserved;
    cell.clearance_m = 2.0F;
  }
  send_object(channels::kTerrain, terrain);

  const auto cloud = newest_of<foxglove::PointCloud>("/cloud");
  EXPECT_EQ(cloud.data().size() / cloud.point_stride(), 200U);
  const auto volume = newest_of<foxglove::PointCloud>("/volume");
  EXPECT_EQ(volume.point_stride(), 15U);
  // One of the two points of each voxel of 0.1 m.
  ASSERT_EQ(volume.data().size() / 15, 100U);
  float x = 0.0F;
  std::memcpy(&x, volume.data().data(), sizeof x);
  EXPECT_NEAR(x, 3.01, 1e-6);
  EXPECT_EQ(volume.data()[12], 1) << "number of the scan";
  EXPECT_EQ(volume.data()[14], 40) << "2 m in units of 0.05 m";
  EXPECT_EQ(static_cast<unsigned char>(volume.data()[99 * 15 + 14]), 255) << "outside the terrain";

  const auto scan = newest_json("/scans");
  EXPECT_EQ(scan["number"], 1);
  EXPECT_EQ(scan["id"], 5);
  EXPECT_EQ(scan["points"], 200);
  EXPECT_NEAR(scan["x"].get<double>(), 3.0, 1e-9);
}

TEST(SceneMemory, IsBoundedForTheVolume) {
  MemoryBus bus;
  TopicBoard board;
  SceneParameters parameters;
  parameters.volume_points_max = 1000;
  const Scene scene(bus, board, parameters);
  for (int i = 0; i < 50; ++i) {
    for (const auto& fragment : split(floor_and_roof(1'700'000'000'000'000 + i, i)))
      bus.inject(1'700'000'000'000'000 + i, channels::kCloud, encode(to_message(fragment)));
  }
  for (TopicId topic = 0; topic < board.topics().size(); ++topic) {
    if (board.topics()[topic].name != "/volume") continue;
    foxglove::PointCloud volume;
    ASSERT_TRUE(volume.ParseFromString(*board.current(topic).front().bytes));
    EXPECT_LE(volume.data().size() / volume.point_stride(), 1000U);
    EXPECT_GT(volume.data().size() / volume.point_stride(), 100U);
  }
}

TEST_F(SceneTest, AddsThePlansOfAScanToItsCard) {
  send(channels::kScanRequest, ScanRequest{.utime = kStartUs, .id = 5, .laser = LaserId::kRear});
  send_object(channels::kCloud, floor_and_roof(kStartUs, 5));
  PlannedPath path;
  path.utime = kStartUs;
  path.id = 9;
  path.outcome = PlanOutcome::kBlocked;
  path.reason = "water";
  path.reached_m = 4.5;
  send(channels::kPath, path);
  const auto all = messages("/scans");
  ASSERT_EQ(all.size(), 1U) << "the second message replaces the first";
  const auto scan = newest_json("/scans");
  EXPECT_EQ(scan["laser"], "LASER_REAR");
  ASSERT_EQ(scan["plans"].size(), 1U);
  EXPECT_EQ(scan["plans"][0]["outcome"], "blocked");
  EXPECT_EQ(scan["plans"][0]["reason"], "water");
  EXPECT_EQ(scan["plans"][0]["reached_m"], 4.5);
  EXPECT_TRUE(scan["plans"][0]["clearance_m"].is_null());
}

TEST_F(SceneTest, DrawsTheEllipseOf95PerCent) {
  send(channels::kPose,
       StampedPose{
           .utime = kStartUs, .T_odom_body = {1.0, 0.0, 0.5 * std::numbers::pi}, .v_body = {}});
  MapCorrection correction;
  correction.utime = kStartUs;
  correction.body_covariance.diagonal() << 0.04, 0.01, 0.001;  // 0.2 m along x of the body
  correction.z_variance = 0.01;
  send(channels::kMapCorrection, correction);
  const auto update = newest_of<foxglove::SceneUpdate>("/uncertainty");
  ASSERT_GE(update.entities_size(), 1);
  EXPECT_EQ(update.entities(0).id(), "robot");
  std::map<std::string, double> metadata;
  for (const auto& pair : update.entities(0).metadata()) {
    if (!pair.value().empty()) metadata[pair.key()] = std::stod(pair.value());
  }
  EXPECT_NEAR(metadata["semi_axis_m"], std::sqrt(5.991) * 0.2, 1e-5);
  EXPECT_NEAR(metadata["height_95_m"], 1.96 * 0.1, 1e-5);
  double y_max = 0.0;
  for (const auto& point : update.entities(0).lines(0).points()) y_max = std::max(y_max, point.y());
  EXPECT_NEAR(y_max, std::sqrt(5.991) * 0.2, 1e-5) << "the body looks along y";
}

TEST_F(SceneTest, SaysWhatTheMissionDoes) {
  MissionPhase phase;
  phase.utime = kStartUs;
  phase.sequence = 1;
  phase.phase = Phase::kExecute;
  phase.reason = "A path was found.";
  phase.scans = 3;
  phase.distance_travelled_m = 12.5;
  send(channels::kPhase, phase);
  send(channels::kPhase, phase);
  send(channels::kStop, StopOrder{.utime = kStartUs, .stopped = true, .reason = "methane"});
  send(channels::kVehicleState,
       VehicleState{.utime = kStartUs + 1, .speed_m_s = 0.4, .battery_share = 0.75});
  const auto mission = newest_json("/mission");
  EXPECT_EQ(mission["phase"], "execute");
  EXPECT_EQ(mission["reason"], "A path was found.");
  EXPECT_EQ(mission["scans"], 3);
  EXPECT_EQ(mission["distance_travelled_m"], 12.5);
  EXPECT_EQ(mission["stopped"], true);
  EXPECT_EQ(mission["stop_reason"], "methane");
  EXPECT_EQ(mission["battery_share"], 0.75);
  EXPECT_TRUE(mission["frontier"].is_null());
  EXPECT_TRUE(mission["methane_share"].is_null());

  std::vector<std::string> events;
  for (const TopicMessage& message : messages("/events")) {
    foxglove::Log log;
    ASSERT_TRUE(log.ParseFromString(*message.bytes));
    events.push_back(log.name() + ": " + log.message());
  }
  EXPECT_THAT(events, ElementsAre("mission: execute: A path was found.", "guard: STOP: methane"));
}

TEST_F(SceneTest, ListsTheStagesWithTheirHealth) {
  Heartbeat heartbeat;
  heartbeat.utime = kStartUs;
  heartbeat.stage = "mapping";
  heartbeat.health = {Health::Level::kDegraded, "late scans"};
  heartbeat.handled = 20;
  send(channels::kHeartbeat, heartbeat);
  bus_.advance_to(kStartUs + 2'000'000);
  heartbeat.stage = "mission";
  heartbeat.utime += 2'000'000;
  send(channels::kHeartbeat, heartbeat);
  const auto stages = newest_json("/processes")["stages"];
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_EQ(stages[0]["name"], "mapping");
  EXPECT_EQ(stages[0]["level"], "degraded");
  EXPECT_EQ(stages[0]["reason"], "late scans");
  EXPECT_NEAR(stages[0]["age_s"].get<double>(), 2.0, 1e-6);
}

TEST_F(SceneTest, KeepsARowOfHistoryASecondAndMovesItWithTheGraph) {
  send_object(channels::kLocalMap, tunnel_map(0, kStartUs, {}, 2.0));
  send_object(channels::kPoseGraph, graph_of(kStartUs, {{0.0, 0.0, 0.0}}));
  for (int i = 0; i < 450; ++i) {
    send(channels::kPose,
         StampedPose{
             .utime = kStartUs + 100'000 * i, .T_odom_body = {0.01 * i, 0.0, 0.0}, .v_body = {}});
  }
  const auto rows = [this] {
    std::vector<nlohmann::json> all;
    for (const TopicMessage& message : messages("/history")) {
      const auto chunk = nlohmann::json::parse(*message.bytes);
      for (const auto& row : chunk["rows"]) all.push_back(row);
    }
    return all;
  };
  ASSERT_EQ(rows().size(), 45U);
  EXPECT_NEAR(rows()[44][1].get<double>(), 4.4, 1e-9);
  EXPECT_TRUE(rows()[44][5].is_null()) << "no speed is known";
  send_object(channels::kPoseGraph, graph_of(kStartUs + 1, {{0.0, 3.0, 0.0}}));
  ASSERT_EQ(rows().size(), 45U);
  EXPECT_NEAR(rows()[0][2].get<double>(), 3.0, 1e-9);
}

}  // namespace
}  // namespace adit
