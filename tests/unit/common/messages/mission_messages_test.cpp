// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <limits>
#include <string_view>

#include <gtest/gtest.h>

#include "common/messages/checks.hpp"
#include "common/messages/cloud_request.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/explore_request.hpp"
#include "common/messages/map_request.hpp"
#include "common/messages/mission_order.hpp"
#include "common/messages/mission_phase.hpp"
#include "common/messages/terrain_made.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Value>
auto over_the_wire(const Value& value) {
  using Message = decltype(to_message(value));
  return from_message(*decode<Message>(encode(to_message(value))));
}

template <class Message, class Value>
std::string_view refusal_after(const Value& value, const std::function<void(Message&)>& change) {
  Message message = to_message(value);
  change(message);
  return from_message(message).refusal();
}

MissionPhase at(std::int64_t utime) {
  MissionPhase phase;
  phase.utime = utime;
  return phase;
}

MissionPhase homeward() {
  MissionPhase phase = at(kUtime);
  phase.sequence = 17;
  phase.phase = Phase::kExecute;
  phase.reason = "a path of 8.1 m";
  phase.homeward = true;
  phase.homeward_reason = "the way on is blocked";
  phase.laser = LaserId::kRear;
  phase.goal_id = 4;
  phase.stub = 3;
  phase.scans = 5;
  phase.travelled_m = 40.5;
  phase.remaining_m = 800.0;
  phase.outcome = MissionOutcome::kStopped;
  phase.complete = true;
  return phase;
}

ExploreRequest blocked() {
  return {kUtime, 6, 800.0, true, BlockedVerdict{kUtime - 9, 1, 1.4, "a beam", true}};
}

TEST(MissionMessages, KeepWhatTheySay) {
  EXPECT_EQ(*over_the_wire(at(kUtime)), at(kUtime));
  EXPECT_EQ(*over_the_wire(homeward()), homeward());
  EXPECT_EQ(*over_the_wire(blocked()), blocked());
  const ExploreRequest plain{kUtime, 1, 12.0, false, {}};
  EXPECT_EQ(*over_the_wire(plain), plain);
  const MissionOrder order{kUtime, MissionOrder::Kind::kStop};
  EXPECT_EQ(*over_the_wire(order), order);
  const MapRequest request{kUtime, "exploration"};
  EXPECT_EQ(*over_the_wire(request), request);
  const CloudRequest clouds{kUtime, "volume_map", 0, {kUtime - 2, kUtime - 1}};
  EXPECT_EQ(*over_the_wire(clouds), clouds);
  const TerrainMade made{kUtime, 4, false};
  EXPECT_EQ(*over_the_wire(made), made);
}

TEST(MissionMessages, AreRefusedWithATimeThatCannotBe) {
  EXPECT_EQ(over_the_wire(at(-1)).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(ExploreRequest{-1, 1, 0.0, false, {}}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(MissionOrder{-1}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(MapRequest{-1, "exploration"}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(TerrainMade{-1}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(MapRequest{kUtime, ""}).refusal(), "no stage is named");
}

TEST(CloudRequestMessage, IsRefusedWhereItCanNotBe) {
  EXPECT_EQ(over_the_wire(CloudRequest{-1, "volume_map", 0, {}}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(CloudRequest{kUtime, "volume_map", -1, {}}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(CloudRequest{kUtime, "volume_map", 0, {-1}}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(CloudRequest{kUtime, "", 0, {}}).refusal(), "no stage is named");
  const std::vector<std::int64_t> many(CloudRequest::kHaveMax + 1, kUtime);
  EXPECT_EQ(over_the_wire(CloudRequest{kUtime, "volume_map", 0, many}).refusal(),
            "more scans than plausible");
}

TEST(PhaseMessage, IsRefusedWhereItSaysNothing) {
  using Message = phase_t;
  const auto refusal = [](const std::function<void(Message&)>& change) {
    return refusal_after<Message>(homeward(), change);
  };
  EXPECT_EQ(refusal([](Message& m) { m.phase = 7; }), "unknown phase");
  EXPECT_EQ(refusal([](Message& m) { m.outcome = -1; }), "unknown outcome");
  EXPECT_EQ(refusal([](Message& m) { m.laser = "LASER_LEFT"; }), "unknown laser");
  EXPECT_EQ(refusal([](Message& m) { m.goal_id = -1; }), "negative count");
  EXPECT_EQ(refusal([](Message& m) { m.stub = -2; }), "target with a negative id");
  EXPECT_EQ(refusal([](Message& m) { m.travelled_m = kNaN; }), "way that is none");
  EXPECT_EQ(refusal([](Message& m) { m.remaining_m = -0.1; }), "way that is none");
}

TEST(ExploreRequestMessage, IsRefusedWhereItSaysNothing) {
  using Message = explore_request_t;
  const auto refusal = [](const std::function<void(Message&)>& change) {
    return refusal_after<Message>(blocked(), change);
  };
  EXPECT_EQ(refusal([](Message& m) { m.id = 0; }), "id that is not positive");
  EXPECT_EQ(refusal([](Message& m) { m.remaining_m = kNaN; }), "way that is none");
  EXPECT_EQ(refusal([](Message& m) { m.reached_m = -1.0; }), "way that is none");
  EXPECT_EQ(refusal([](Message& m) { m.blocked_stub = -2; }), "target with a negative id");
  EXPECT_EQ(refusal([](Message& m) { m.blocked_utime = -1; }), kImplausibleTime);
}

TEST(MissionOrderMessage, IsRefusedWhereThereIsNoSuchOrder) {
  const auto refusal =
      refusal_after<mission_order_t>(MissionOrder{kUtime}, [](mission_order_t& m) { m.kind = 4; });
  EXPECT_EQ(refusal, "unknown order");
}

}  // namespace
}  // namespace adit
