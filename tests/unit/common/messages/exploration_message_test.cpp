// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "common/messages/checks.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/exploration_report.hpp"
#include "common/messages/pieces.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// With so many stubs, the last of them open, and corridors in a chain.
ExplorationReport report_of(int stubs, int corridors) {
  ExplorationReport report;
  report.utime = kUtime;
  report.revision = 3;
  report.decision = {ExplorationDecision::Kind::kGoTo, {1, 2, 0.5}, 12.0, 0, false, "onwards"};
  report.T_odom_goal = {3, 4, 0.25};
  report.budget = {100.0, 20.0, 50.0};
  for (int i = 0; i < stubs; ++i) {
    const auto state = i + 1 == stubs ? StubState::kOpen : StubState::kExplored;
    report.stubs.push_back({i, 2, {1.0 * i, 5}, {0, 1}, 2.5, state, kUtime, "it was seen"});
  }
  report.corridors.nodes.push_back({{0, 0}, CorridorNode::Kind::kDeadEnd});
  for (int i = 0; i < corridors; ++i) {
    report.corridors.nodes.push_back({{i + 1.0, 0}, CorridorNode::Kind::kJunction});
    report.corridors.corridors.push_back({i, i + 1, 1.5, 3.0, {{i, 0}, {i + 0.5, 1}, {i + 1, 0}}});
  }
  return report;
}

Result<ExplorationReport> over_the_wire(const ExplorationReport& report) {
  return from_message(*decode<exploration_t>(encode(to_message(report))));
}

std::string_view refusal_after(const std::function<void(exploration_t&)>& change) {
  exploration_t message = to_message(report_of(2, 2));
  change(message);
  return from_message(message).refusal();
}

TEST(ExplorationMessage, ComesBackAsItWas) {
  EXPECT_EQ(*over_the_wire(report_of(3, 4)), report_of(3, 4));
  EXPECT_EQ(*over_the_wire(ExplorationReport{}), ExplorationReport{});
}

TEST(ExplorationMessage, FitsAPieceAndLeavesOutWhatIsClosedFirst) {
  const exploration_t message = to_message(report_of(3000, 1500));
  EXPECT_LE(encode(message).size(), kPieceBytes);
  EXPECT_EQ(message.n_stubs_found, 3000);
  EXPECT_EQ(message.n_corridors_found, 1500);
  EXPECT_LT(message.n_stubs, 3000);
  ASSERT_GT(message.n_stubs, 100);
  EXPECT_EQ(message.stubs[0].id, 2999);  // it is open
  EXPECT_GT(message.n_corridors, 100);
  EXPECT_TRUE(from_message(message));
}

TEST(ExplorationMessage, CutsLongSentences) {
  ExplorationReport report = report_of(1, 0);
  report.decision.reason = std::string(1000, 'a');
  report.stubs[0].evidence = std::string(1000, 'b');
  const auto back = over_the_wire(report);
  EXPECT_EQ(back->decision.reason.size(), kSentenceMax);
  EXPECT_EQ(back->stubs[0].evidence.size(), kSentenceMax);
}

TEST(ExplorationMessage, IsRefusedWhereItCannotBe) {
  using Message = exploration_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](Message& m) { m.revision = -1; }), "negative revision");
  EXPECT_EQ(refusal_after([](Message& m) { m.kind = 5; }), "unknown kind of decision");
  EXPECT_EQ(refusal_after([](Message& m) { m.stub = -2; }), "target with a negative id");
  EXPECT_EQ(refusal_after([](Message& m) { m.T_odom_goal[2] = kNaN; }), "pose is not finite");
  EXPECT_EQ(refusal_after([](Message& m) { m.home_m = kNaN; }), "distance is not finite");
  EXPECT_EQ(refusal_after([](Message& m) { m.n_stubs_found = 1; }), "fewer stubs than are there");
  EXPECT_EQ(refusal_after([](Message& m) { m.n_corridors_found = 1; }),
            "fewer corridors than are there");
}

TEST(ExplorationMessage, IsRefusedWithPartsThatCannotBe) {
  using Message = exploration_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.stubs[1].id = -1; }),
            "stub with a negative id or local map");
  EXPECT_EQ(refusal_after([](Message& m) { m.stubs[1].state = 8; }), "stub of an unknown state");
  EXPECT_EQ(refusal_after([](Message& m) { m.stubs[1].utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](Message& m) { m.stubs[1].p_map[0] = kNaN; }),
            "stub that is not finite");
  EXPECT_EQ(refusal_after([](Message& m) { m.nodes[1].kind = 3; }), "node of an unknown kind");
  EXPECT_EQ(refusal_after([](Message& m) { m.nodes[1].p_map[1] = kNaN; }),
            "node that is not finite");
  EXPECT_EQ(refusal_after([](Message& m) { m.corridors[1].to = 3; }), "corridor without its nodes");
  EXPECT_EQ(refusal_after([](Message& m) { m.corridors[1].length_m = kNaN; }),
            "corridor that is not finite");
  EXPECT_EQ(refusal_after([](Message& m) { m.corridors[1].points_map.resize(1); }),
            "corridor without two ends");
  EXPECT_EQ(refusal_after([](Message& m) {
              m.corridors[1].points_map[0][1] = std::numeric_limits<float>::infinity();
            }),
            "corridor that is not finite");
}

}  // namespace
}  // namespace adit
