// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The stage is killed repeatedly during an exploration, and continues as if it had not been.
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "procs/exploration/exploration_node.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/robots/exploring_robot.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/exploration/test_mines.hpp"

namespace adit {
namespace {

using Kind = ExplorationDecision::Kind;
constexpr std::int64_t kSecond = 1'000'000;
constexpr double kBudgetM = 1500.0;
constexpr std::size_t kDecisionsMax = 300;
constexpr double kMapM = 5.0;
constexpr double kOnwardM = 6.0;
constexpr double kProgressMinM =
    1.0;  // after which the surroundings are observed again before anything is blocked

/// The stage between two restarts, with a mapping that has all local maps.
class StageRun {
 public:
  StageRun(const std::filesystem::path& journal, const test::ExploringRobot& robot,
           const std::vector<LocalMap>& maps)
      : robot_(robot), maps_(maps) {
    ExplorationNodeParams params;
    params.journal = journal.string();
    subscribe<exploration_t>(bus_, channels::kExploration, Delivery::queued(100),
                             [this](const ExplorationReport& report) { report_ = report; });
    subscribe<map_request_t>(bus_, channels::kMapRequest, Delivery::queued(10),
                             [this](const MapRequest&) {
                               for (const LocalMap& map : maps_) send(map);
                               send_graph();
                             });
    node_ = std::make_unique<ExplorationNode>(bus_, params);
    send_pose();
  }

  void send(const LocalMap& map) {
    for (const LocalMapFragment& fragment : split(map)) {
      publish(bus_, channels::kLocalMap, to_message(fragment));
    }
  }
  void send(const TerrainMap& terrain) {
    for (const TerrainFragment& fragment : split(terrain)) {
      publish(bus_, channels::kTerrain, to_message(fragment));
    }
  }
  void send_graph() {
    for (const PoseGraphFragment& fragment : split(robot_.graph())) {
      publish(bus_, channels::kPoseGraph, to_message(fragment));
    }
    publish(bus_, channels::kMapCorrection,
            to_message(MapCorrection{
                robot_.utime(), robot_.graph().revision, 0, maps_.back().id, {}, {}}));
  }
  void send_pose() {
    bus_.inject(robot_.utime(), channels::kPose,
                encode(to_message(StampedPose{robot_.utime(), robot_.T_map_body(), {}})));
  }
  /// Repeats until there is an answer, as the mission does.
  ExplorationReport request_decision(const ExploreRequest& request) {
    report_ = {};
    for (int i = 0; i < 10 && report_.request != request.id; ++i) {
      publish(bus_, channels::kExploreRequest, to_message(request));
      bus_.advance_to(bus_.now_utime() + kSecond);
    }
    return report_;
  }

 private:
  MemoryBus bus_;
  const test::ExploringRobot& robot_;
  const std::vector<LocalMap>& maps_;
  ExplorationReport report_;
  std::unique_ptr<ExplorationNode> node_;
};

struct Outcome {
  std::vector<ExplorationDecision> decisions;
  ExplorationReport last;
  double missed_m = 0.0;
  double distance_travelled_m = 0.0;
  int blocked = 0;
  int restarts = 0;
};

/// A mission that requests, drives, and requests again, and kills the stage in this share of its
/// steps.
class Mission {
 public:
  Mission(const test::PlanarMine& mine, double restart_share, unsigned seed)
      : robot_(mine), restarts_(restart_share), random_(seed) {}

  Outcome run() {
    maps_.push_back(robot_.last_map());
    start_stage();
    while (robot_.distance_travelled_m() < kBudgetM && outcome_.decisions.size() < kDecisionsMax) {
      const ExplorationReport report = decide();
      outcome_.decisions.push_back(report.decision);
      outcome_.last = report;
      if (report.decision.kind == Kind::kDone || report.decision.kind == Kind::kStay) break;
      drive(report);
    }
    outcome_.missed_m = robot_.missed_m();
    outcome_.distance_travelled_m = robot_.distance_travelled_m();
    return outcome_;
  }

  std::filesystem::path journal() const { return scratch_ / "exploration.journal"; }

 private:
  void start_stage() {
    stage_.reset();
    stage_ = std::make_unique<StageRun>(journal(), robot_, maps_);
  }

  void maybe_restart() {
    if (!restarts_(random_)) return;
    ++outcome_.restarts;
    start_stage();
  }

  ExplorationReport decide() {
    const double remaining_m = kBudgetM - robot_.distance_travelled_m();
    const ExplorationReport report =
        stage_->request_decision({robot_.utime(), ++id_, remaining_m, false, verdict_});
    verdict_.reset();
    maybe_restart();
    return report;
  }

  void drive(const ExplorationReport& report) {
    std::vector<Eigen::Vector2d> route{report.decision.T_map_goal.translation()};
    if (report.decision.kind == Kind::kAlong) {
      const Frontier& frontier =
          report.frontiers[static_cast<std::size_t>(report.decision.frontier)];
      for (double distance_ahead_m = 0.5; distance_ahead_m <= kOnwardM; distance_ahead_m += 0.5) {
        route.emplace_back(frontier.p_map + distance_ahead_m * frontier.direction_map);
      }
    }
    const double distance_m = robot_.drive(route, kMapM);
    maps_.push_back(robot_.last_map());
    stage_->send_pose();
    maybe_restart();
    stage_->send(maps_.back());
    maybe_restart();
    stage_->send_graph();
    maybe_restart();
    if (!robot_.stopped() || distance_m >= kProgressMinM) return;
    verdict_ = {robot_.utime(), report.decision.frontier, 0.0, "the planner found no path"};
    ++outcome_.blocked;
  }

  test::ScratchFolder scratch_;
  test::ExploringRobot robot_;
  std::bernoulli_distribution restarts_;
  std::mt19937 random_;
  std::vector<LocalMap> maps_;
  std::unique_ptr<StageRun> stage_;
  std::optional<BlockedVerdict> verdict_;
  std::int32_t id_ = 0;
  Outcome outcome_;
};

/// With an obstacle across a tunnel that lasers do not detect.
test::PlanarMine mine_with_invisible_obstacle() {
  test::PlanarMine mine = tunnel_mine(rooms_and_pillars());
  const auto reachable = mine.reachable;
  mine.reachable = [reachable](const Eigen::Vector2d& p) {
    const bool in_it = std::abs(p.x() - 28.0) < 1.0 && std::abs(p.y() - 24.0) < 3.0;
    return reachable(p) && !in_it;
  };
  return mine;
}

class ExplorationRestart : public testing::TestWithParam<unsigned> {};

TEST_P(ExplorationRestart, DoesNotChangeTheDecisions) {
  const test::PlanarMine mine = mine_with_invisible_obstacle();
  const Outcome uninterrupted = Mission(mine, 0.0, 0).run();
  const Outcome restarted = Mission(mine, 0.25, GetParam()).run();
  EXPECT_GT(restarted.restarts, 5);
  EXPECT_GT(uninterrupted.blocked, 0);
  EXPECT_EQ(restarted.blocked, uninterrupted.blocked);
  EXPECT_EQ(restarted.last.decision.kind, Kind::kDone);
  EXPECT_EQ(restarted.last.decision.complete, uninterrupted.last.decision.complete);
  EXPECT_EQ(restarted.missed_m, uninterrupted.missed_m);
  EXPECT_EQ(restarted.decisions, uninterrupted.decisions);
  EXPECT_EQ(restarted.last.frontiers, uninterrupted.last.frontiers);
}

INSTANTIATE_TEST_SUITE_P(Seed, ExplorationRestart, testing::Values(1U, 2U));

TEST(ExplorationJournal, SkipsTornRecordsAndDiscardsTheStateOfAnotherMap) {
  const test::ScratchFolder scratch;
  const std::filesystem::path path = scratch / "exploration.journal";
  StoredExploration stored;
  stored.map_utime = 5;
  stored.exploration.barriers = {{Barrier::Kind::kBlocked, 0, 3, {1.0, 0.1}, {0.0, 1.0}, "a beam"}};
  stored.exploration.frontiers.resize(2);
  stored.exploration.frontiers[1].frontier.id = 1;
  stored.exploration.frontiers[1].frontier.evidence = "observed by local map 3";
  stored.exploration.frontiers[1].track.p_local = {1.0 / 3.0, -0.1};
  stored.exploration.target = 1;
  stored.request = ExploreRequest{kSecond, 3, 1.0 / 7.0, true, {}};
  stored.distance_travelled_m = 1.0 / 3.0;
  {
    ExplorationJournal journal(path);
    journal.store(stored);
  }
  {
    ExplorationJournal journal(path);
    EXPECT_EQ(journal.restored().exploration, stored.exploration);
    EXPECT_EQ(journal.restored().request, stored.request);
    EXPECT_EQ(journal.restored().distance_travelled_m, stored.distance_travelled_m);
    stored.exploration.frontiers[1].frontier.state = FrontierState::kBlocked;
    stored.distance_travelled_m = 2.0;
    journal.store(stored);
  }
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  std::filesystem::remove(journal_copy(path));
  {
    ExplorationJournal journal(path);
    EXPECT_EQ(journal.restored().exploration, stored.exploration);
    EXPECT_EQ(journal.restored().distance_travelled_m, 1.0 / 3.0);  // the last record is torn
    StoredExploration other;
    other.map_utime = 6;
    journal.store(other);
  }
  EXPECT_TRUE(ExplorationJournal(path).restored().exploration.frontiers.empty());
}

ScannedGround scanned_ground(int local_map) {
  ScannedGround ground{local_map, {1.0 / 3.0, 0.1, -0.2}, Grid2<ScannedCell>({{-2, 0}, {3, 4}})};
  ground.cells.at({1, 2}) = ScannedCell::kGround;
  ground.cells.at({2, 3}) = ScannedCell::kRock;
  return ground;
}

TEST(ExplorationJournal, RestoresTheGroundOf3DScansOfItsMap) {
  const test::ScratchFolder scratch;
  const std::filesystem::path path = scratch / "exploration.journal";
  StoredExploration stored;
  stored.map_utime = 5;
  stored.exploration.verify_walls = true;
  {
    ExplorationJournal journal(path);
    journal.append(5, scanned_ground(0));  // before the first decision
    journal.store(stored);
    journal.append(5, scanned_ground(1));
  }
  for (int restart = 0; restart < 2; ++restart) {
    ExplorationJournal journal(path);
    EXPECT_EQ(journal.restored().grounds,
              std::vector<ScannedGround>({scanned_ground(0), scanned_ground(1)}));
    EXPECT_TRUE(journal.restored().exploration.verify_walls);
    journal.store(journal.restored());
  }
  {
    ExplorationJournal journal(path);
    StoredExploration other;
    other.map_utime = 6;
    journal.store(other);
    journal.append(6, scanned_ground(2));
  }
  const ExplorationJournal journal(path);
  EXPECT_EQ(journal.restored().grounds, std::vector<ScannedGround>({scanned_ground(2)}));
  EXPECT_FALSE(journal.restored().exploration.verify_walls);
}

/// At the start of straight().
class A3DScan : public testing::Test {
 protected:
  A3DScan() {
    terrain_.utime = robot_.utime();
    terrain_.p_level_corner = {-1.0, -1.0};
    TerrainCell ground;
    ground.ground = Ground::kObserved;
    ground.clearance_m = 2.0F;
    terrain_.cells = Grid2<TerrainCell>(20, 20, ground);
  }
  [[nodiscard]] ExploreRequest request(int id) const {
    return {robot_.utime(), id, kBudgetM, false, {}};
  }
  void expect_stored() const {
    const std::vector<ScannedGround> grounds = ExplorationJournal(path_).restored().grounds;
    ASSERT_EQ(grounds.size(), 1U);
    EXPECT_EQ(grounds[0].local_map, 0);
    const auto cell = cell_of({0.1, 0.1}, KnownSpaceParams{}.tiles.resolution_m);
    EXPECT_EQ(grounds[0].cells.get(cell), ScannedCell::kGround);
  }

  test::ScratchFolder scratch_;
  std::filesystem::path path_ = scratch_ / "exploration.journal";
  test::PlanarMine mine_ = tunnel_mine(straight());
  test::ExploringRobot robot_{mine_};
  std::vector<LocalMap> maps_{robot_.last_map()};
  TerrainMap terrain_;
};

/// It is placed, and stored, after the first pose graph.
TEST_F(A3DScan, IsKeptIfItArrivedBeforeTheMap) {
  {
    StageRun stage(path_, robot_, maps_);
    stage.send(terrain_);
    stage.request_decision(request(1));
  }
  expect_stored();
}

TEST_F(A3DScan, IsStoredOnceTheDiskHasRoom) {
  {
    StageRun stage(path_, robot_, maps_);
    stage.request_decision(request(1));
    {
      const test::FileSizeLimit full(std::filesystem::file_size(path_));
      stage.send(terrain_);
      stage.request_decision(request(2));
    }
    stage.request_decision(request(3));
    stage.request_decision(request(4));
  }
  expect_stored();
}

}  // namespace
}  // namespace adit
