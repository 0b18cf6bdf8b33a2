// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mission.hpp"

#include <functional>
#include <limits>
#include <string_view>

#include <gtest/gtest.h>

#include "common/messages/codec.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/fields/quantities.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Value>
auto round_trip(const Value& value) {
  using Message = decltype(to_message(value));
  return from_message(*decode<Message>(encode(to_message(value))));
}

template <class Message, class Value>
std::string_view rejection_after(const Value& value, const std::function<void(Message&)>& change) {
  Message message = to_message(value);
  change(message);
  return from_message(message).rejection();
}

MissionPhase at(std::int64_t utime) {
  MissionPhase phase;
  phase.utime = utime;
  return phase;
}

MissionPhase returning_home() {
  MissionPhase phase = at(kUtime);
  phase.sequence = 17;
  phase.phase = Phase::kExecute;
  phase.reason = "a path of 8.1 m";
  phase.returning_home = true;
  phase.return_home_reason = "the route ahead is blocked";
  phase.laser = LaserId::kRear;
  phase.goal_id = 4;
  phase.frontier = 3;
  phase.scans = 5;
  phase.distance_travelled_m = 40.5;
  phase.remaining_m = 800.0;
  phase.outcome = MissionOutcome::kStopped;
  phase.complete = true;
  return phase;
}

ExploreRequest blocked() {
  return {kUtime, 6, 800.0, true, BlockedVerdict{kUtime - 9, 1, 1.4, "a beam", true}};
}

TEST(MissionMessages, SurviveARoundTrip) {
  EXPECT_EQ(*round_trip(at(kUtime)), at(kUtime));
  EXPECT_EQ(*round_trip(returning_home()), returning_home());
  EXPECT_EQ(*round_trip(blocked()), blocked());
  const ExploreRequest plain{kUtime, 1, 12.0, false, {}};
  EXPECT_EQ(*round_trip(plain), plain);
  const MissionOrder order{kUtime, MissionOrder::Kind::kStop};
  EXPECT_EQ(*round_trip(order), order);
  const MapRequest request{kUtime, "exploration"};
  EXPECT_EQ(*round_trip(request), request);
  const CloudRequest clouds{kUtime, 0, {kUtime - 2, kUtime - 1}};
  EXPECT_EQ(*round_trip(clouds), clouds);
  const TerrainReady made{kUtime, 4, false};
  EXPECT_EQ(*round_trip(made), made);
}

TEST(MissionMessages, AreRejectedWithImplausibleTimes) {
  EXPECT_EQ(round_trip(at(-1)).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(ExploreRequest{-1, 1, 0.0, false, {}}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(MissionOrder{-1}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(MapRequest{-1, "exploration"}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(TerrainReady{-1}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(MapRequest{kUtime, ""}).rejection(), "no stage");
}

TEST(CloudRequestMessage, IsRejectedWithInvalidContent) {
  EXPECT_EQ(round_trip(CloudRequest{-1, 0, {}}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(CloudRequest{kUtime, -1, {}}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(CloudRequest{kUtime, 0, {-1}}).rejection(), kImplausibleTime);
  const std::vector<std::int64_t> many(CloudRequest::kReceivedMax + 1, kUtime);
  EXPECT_EQ(round_trip(CloudRequest{kUtime, 0, many}).rejection(), "implausible number of scans");
}

TEST(PhaseMessage, IsRejectedWithInvalidContent) {
  using Message = phase_t;
  const auto rejection = [](const std::function<void(Message&)>& change) {
    return rejection_after<Message>(returning_home(), change);
  };
  EXPECT_EQ(rejection([](Message& m) { m.phase = 7; }), "unknown phase");
  EXPECT_EQ(rejection([](Message& m) { m.outcome = -1; }), "unknown outcome");
  EXPECT_EQ(rejection([](Message& m) { m.laser = "LASER_LEFT"; }), "unknown laser");
  EXPECT_EQ(rejection([](Message& m) { m.goal_id = -1; }), "negative count");
  EXPECT_EQ(rejection([](Message& m) { m.frontier = -2; }), "negative frontier id");
  EXPECT_EQ(rejection([](Message& m) { m.distance_travelled_m = kNaN; }), "invalid distance");
  EXPECT_EQ(rejection([](Message& m) { m.remaining_m = -0.1; }), "invalid distance");
}

TEST(ExploreRequestMessage, IsRejectedWithInvalidContent) {
  using Message = explore_request_t;
  const auto rejection = [](const std::function<void(Message&)>& change) {
    return rejection_after<Message>(blocked(), change);
  };
  EXPECT_EQ(rejection([](Message& m) { m.id = 0; }), "id is not positive");
  EXPECT_EQ(rejection([](Message& m) { m.remaining_m = kNaN; }), "invalid distance");
  EXPECT_EQ(rejection([](Message& m) { m.reached_m = -1.0; }), "invalid distance");
  EXPECT_EQ(rejection([](Message& m) { m.blocked_frontier = -2; }), "negative frontier id");
  EXPECT_EQ(rejection([](Message& m) { m.blocked_utime = -1; }), kImplausibleTime);
}

TEST(MissionOrderMessage, IsRejectedForAnUnknownOrder) {
  const auto rejection = rejection_after<mission_order_t>(MissionOrder{kUtime},
                                                          [](mission_order_t& m) { m.kind = 4; });
  EXPECT_EQ(rejection, "unknown order");
}

}  // namespace
}  // namespace adit
