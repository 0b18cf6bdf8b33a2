// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The stage dies again and again while a mine is explored, and goes on as if it had not.
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
#include "common/bus/typed.hpp"
#include "common/messages/exploration_report.hpp"
#include "common/messages/explore_request.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/map_request.hpp"
#include "procs/exploration/exploration_node.hpp"
#include "tests/support/exploring_robot.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/exploration/mines.hpp"

namespace adit {
namespace {

using Kind = ExplorationDecision::Kind;
constexpr std::int64_t kSecond = 1'000'000;
constexpr double kBudgetM = 1500.0;
constexpr std::size_t kDecisionsMax = 300;
constexpr double kMapM = 5.0;
constexpr double kOnwardM = 6.0;
constexpr double kSomeWayM = 1.0;  // after which it is seen anew before anything is blocked

/// The stage from its start to its death, with a mapping that has all local maps.
class Life {
 public:
  Life(const std::filesystem::path& journal, const test::ExploringRobot& robot,
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
    for (const LocalMapPiece& piece : divide(map)) {
      publish(bus_, channels::kLocalMap, to_message(piece));
    }
  }
  void send_graph() {
    for (const PoseGraphPiece& piece : divide(robot_.graph())) {
      publish(bus_, channels::kPoseGraph, to_message(piece));
    }
    publish(bus_, channels::kMapCorrection,
            to_message(MapCorrection{
                robot_.utime(), robot_.graph().revision, 0, maps_.back().id, {}, {}}));
  }
  void send_pose() {
    bus_.inject(robot_.utime(), channels::kPose,
                encode(to_message(StampedPose{robot_.utime(), robot_.T_map_body(), {}})));
  }
  /// Once more while there is no answer, as the mission does.
  ExplorationReport ask(const ExploreRequest& request) {
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
  double travelled_m = 0.0;
  int blocked = 0;
  int deaths = 0;
};

/// A mission that asks, goes, and asks again, and kills the stage in this share of its steps.
class Mission {
 public:
  Mission(const test::LightMine& mine, double death_share, unsigned seed)
      : robot_(mine), dies_(death_share), random_(seed) {}

  Outcome run() {
    maps_.push_back(robot_.last_map());
    begin_life();
    while (robot_.travelled_m() < kBudgetM && outcome_.decisions.size() < kDecisionsMax) {
      const ExplorationReport report = decide();
      outcome_.decisions.push_back(report.decision);
      outcome_.last = report;
      if (report.decision.kind == Kind::kDone || report.decision.kind == Kind::kStay) break;
      go(report);
    }
    outcome_.missed_m = robot_.missed_m();
    outcome_.travelled_m = robot_.travelled_m();
    return outcome_;
  }

  std::filesystem::path journal() const { return scratch_ / "exploration.journal"; }

 private:
  void begin_life() {
    life_.reset();
    life_ = std::make_unique<Life>(journal(), robot_, maps_);
  }

  void perhaps_die() {
    if (!dies_(random_)) return;
    ++outcome_.deaths;
    begin_life();
  }

  ExplorationReport decide() {
    const double remaining_m = kBudgetM - robot_.travelled_m();
    const ExplorationReport report =
        life_->ask({robot_.utime(), ++id_, remaining_m, false, verdict_});
    verdict_.reset();
    perhaps_die();
    return report;
  }

  void go(const ExplorationReport& report) {
    std::vector<Eigen::Vector2d> route{report.decision.T_map_goal.translation()};
    if (report.decision.kind == Kind::kAlong) {
      const Stub& stub = report.stubs[static_cast<std::size_t>(report.decision.stub)];
      for (double on = 0.5; on <= kOnwardM; on += 0.5) {
        route.emplace_back(stub.p_map + on * stub.direction_map);
      }
    }
    const double way = robot_.go(route, kMapM);
    maps_.push_back(robot_.last_map());
    life_->send_pose();
    perhaps_die();
    life_->send(maps_.back());
    perhaps_die();
    life_->send_graph();
    perhaps_die();
    if (!robot_.stopped() || way >= kSomeWayM) return;
    verdict_ = {robot_.utime(), report.decision.stub, 0.0, "the planner found no path"};
    ++outcome_.blocked;
  }

  test::ScratchFolder scratch_;
  test::ExploringRobot robot_;
  std::bernoulli_distribution dies_;
  std::mt19937 random_;
  std::vector<LocalMap> maps_;
  std::unique_ptr<Life> life_;
  std::optional<BlockedVerdict> verdict_;
  std::int32_t id_ = 0;
  Outcome outcome_;
};

/// With something across a drift that lasers do not see.
test::LightMine mine_with_a_blockade() {
  test::LightMine mine = drift_mine(rooms_and_pillars());
  const auto reachable = mine.reachable;
  mine.reachable = [reachable](const Eigen::Vector2d& p) {
    const bool in_it = std::abs(p.x() - 28.0) < 1.0 && std::abs(p.y() - 24.0) < 3.0;
    return reachable(p) && !in_it;
  };
  return mine;
}

class ExplorationSurvives : public testing::TestWithParam<unsigned> {};

TEST_P(ExplorationSurvives, DeathAndDecidesAsItWouldHave) {
  const test::LightMine mine = mine_with_a_blockade();
  const Outcome alive = Mission(mine, 0.0, 0).run();
  const Outcome killed = Mission(mine, 0.25, GetParam()).run();
  EXPECT_GT(killed.deaths, 5);
  EXPECT_GT(alive.blocked, 0);
  EXPECT_EQ(killed.blocked, alive.blocked);
  EXPECT_EQ(killed.last.decision.kind, Kind::kDone);
  EXPECT_EQ(killed.last.decision.complete, alive.last.decision.complete);
  EXPECT_EQ(killed.missed_m, alive.missed_m);
  EXPECT_EQ(killed.decisions, alive.decisions);
  EXPECT_EQ(killed.last.stubs, alive.last.stubs);
}

INSTANTIATE_TEST_SUITE_P(Seed, ExplorationSurvives, testing::Values(1U, 2U));

TEST(ExplorationJournal, LeavesOutWhatIsTornAndForgetsWhatBelongsToAnotherMap) {
  const test::ScratchFolder scratch;
  const std::filesystem::path path = scratch / "exploration.journal";
  KeptExploration kept;
  kept.map_utime = 5;
  kept.exploration.barriers = {{Barrier::Kind::kBlocked, 0, 3, {1.0, 0.1}, {0.0, 1.0}, "a beam"}};
  kept.exploration.stubs.resize(2);
  kept.exploration.stubs[1].stub.id = 1;
  kept.exploration.stubs[1].stub.evidence = "seen by local map 3";
  kept.exploration.stubs[1].hold.p_local = {1.0 / 3.0, -0.1};
  kept.exploration.target = 1;
  kept.request = ExploreRequest{kSecond, 3, 1.0 / 7.0, true, {}};
  kept.travelled_m = 1.0 / 3.0;
  {
    ExplorationJournal journal(path);
    journal.keep(kept);
  }
  {
    ExplorationJournal journal(path);
    EXPECT_EQ(journal.restored().exploration, kept.exploration);
    EXPECT_EQ(journal.restored().request, kept.request);
    EXPECT_EQ(journal.restored().travelled_m, kept.travelled_m);
    kept.exploration.stubs[1].stub.state = StubState::kBlocked;
    kept.travelled_m = 2.0;
    journal.keep(kept);
  }
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  {
    ExplorationJournal journal(path);
    EXPECT_EQ(journal.restored().exploration, kept.exploration);
    EXPECT_EQ(journal.restored().travelled_m, 1.0 / 3.0);  // the last record is torn
    KeptExploration other;
    other.map_utime = 6;
    journal.keep(other);
  }
  EXPECT_TRUE(ExplorationJournal(path).restored().exploration.stubs.empty());
}

}  // namespace
}  // namespace adit
