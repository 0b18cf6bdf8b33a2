// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/exploration.hpp"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "common/messages/codec.hpp"
#include "common/messages/fields/quantities.hpp"
#include "common/messages/fragments.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A report with so many frontiers, the last one open, and a chain of corridors.
ExplorationReport report_of(int frontiers, int corridors) {
  ExplorationReport report;
  report.utime = kUtime;
  report.revision = 3;
  report.decision = {ExplorationDecision::Kind::kGoTo, {1, 2, 0.5}, 12.0, 0, false, "onwards"};
  report.T_odom_goal = {3, 4, 0.25};
  report.budget = {100.0, 50.0};
  for (int i = 0; i < frontiers; ++i) {
    const auto state = i + 1 == frontiers ? FrontierState::kOpen : FrontierState::kExplored;
    report.frontiers.push_back({i, 2, {1.0 * i, 5}, {0, 1}, 2.5, state, kUtime, "it was seen"});
  }
  report.corridors.nodes.push_back({{0, 0}, CorridorNode::Kind::kDeadEnd});
  for (int i = 0; i < corridors; ++i) {
    report.corridors.nodes.push_back({{i + 1.0, 0}, CorridorNode::Kind::kJunction});
    report.corridors.corridors.push_back({i, i + 1, 1.5, 3.0, {{i, 0}, {i + 0.5, 1}, {i + 1, 0}}});
  }
  return report;
}

Result<ExplorationReport> round_trip(const ExplorationReport& report) {
  return from_message(*decode<exploration_t>(encode(to_message(report))));
}

std::string_view rejection_after(const std::function<void(exploration_t&)>& change) {
  exploration_t message = to_message(report_of(2, 2));
  change(message);
  return from_message(message).rejection();
}

TEST(ExplorationMessage, SurvivesARoundTrip) {
  EXPECT_EQ(*round_trip(report_of(3, 4)), report_of(3, 4));
  EXPECT_EQ(*round_trip(ExplorationReport{}), ExplorationReport{});
}

TEST(ExplorationMessage, FitsTheSizeLimitAndOmitsClosedFrontiersFirst) {
  const exploration_t message = to_message(report_of(3000, 1500));
  EXPECT_LE(encode(message).size(), kFragmentBytes);
  EXPECT_EQ(message.n_frontiers_found, 3000);
  EXPECT_EQ(message.n_corridors_found, 1500);
  EXPECT_LT(message.n_frontiers, 3000);
  ASSERT_GT(message.n_frontiers, 100);
  EXPECT_EQ(message.frontiers[0].id, 2999);  // open
  EXPECT_GT(message.n_corridors, 100);
  EXPECT_TRUE(from_message(message));
}

TEST(ExplorationMessage, TruncatesLongSentences) {
  ExplorationReport report = report_of(1, 0);
  report.decision.reason = std::string(1000, 'a');
  report.frontiers[0].evidence = std::string(1000, 'b');
  const auto back = round_trip(report);
  EXPECT_EQ(back->decision.reason.size(), kSentenceMax);
  EXPECT_EQ(back->frontiers[0].evidence.size(), kSentenceMax);
}

TEST(ExplorationMessage, IsRejectedWithInvalidContent) {
  using Message = exploration_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.revision = -1; }), "negative revision");
  EXPECT_EQ(rejection_after([](Message& m) { m.kind = 5; }), "unknown decision");
  EXPECT_EQ(rejection_after([](Message& m) { m.frontier = -2; }), "negative frontier id");
  EXPECT_EQ(rejection_after([](Message& m) { m.T_odom_goal[2] = kNaN; }), kImplausibleHeading);
  EXPECT_EQ(rejection_after([](Message& m) { m.explored_m = kNaN; }), kInvalidDistance);
  EXPECT_EQ(rejection_after([](Message& m) { m.n_frontiers_found = 1; }),
            "frontier count below the number of frontiers");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_corridors_found = 1; }),
            "corridor count below the number of corridors");
}

TEST(ExplorationMessage, IsRejectedWithInvalidParts) {
  using Message = exploration_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.frontiers[1].id = -1; }),
            "frontier with a negative id or local map");
  EXPECT_EQ(rejection_after([](Message& m) { m.frontiers[1].state = 8; }),
            "unknown frontier state");
  EXPECT_EQ(rejection_after([](Message& m) { m.frontiers[1].utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.frontiers[1].p_map[0] = kNaN; }),
            kImplausiblePosition);
  EXPECT_EQ(rejection_after([](Message& m) { m.nodes[1].kind = 3; }), "unknown node kind");
  EXPECT_EQ(rejection_after([](Message& m) { m.nodes[1].p_map[1] = kNaN; }), kImplausiblePosition);
  EXPECT_EQ(rejection_after([](Message& m) { m.corridors[1].to = 3; }), "corridor without nodes");
  EXPECT_EQ(rejection_after([](Message& m) { m.corridors[1].length_m = kNaN; }), kInvalidDistance);
  EXPECT_EQ(rejection_after([](Message& m) { m.corridors[1].points_map.resize(1); }),
            "corridor with fewer than two points");
  EXPECT_EQ(rejection_after([](Message& m) {
              m.corridors[1].points_map[0][1] = std::numeric_limits<float>::infinity();
            }),
            kImplausiblePosition);
}

}  // namespace
}  // namespace adit
