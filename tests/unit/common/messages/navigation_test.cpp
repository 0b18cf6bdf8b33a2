// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Scan requests, goals, planned paths and driving states.
#include "common/messages/navigation.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"
#include "common/messages/sensing.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;
using test::round_trip;

PlanGoal goal(std::int64_t utime, std::int32_t id = 4) {
  return {utime, id, PlanGoal::Kind::kToPose, {20.0, -3.0, 0.1}, 12.0};
}

PlannedPath found() {
  PlannedPath path;
  path.utime = kUtime;
  path.id = 4;
  path.outcome = PlanOutcome::kFound;
  path.reason = "free as far as it was seen";
  path.points = {{{1.0, 2.0, 0.7}, 0.2, false, 0.4, 0.0},
                 {{1.3, 2.2, 0.8}, 0.0, true, std::numeric_limits<double>::infinity(), 9.5}};
  path.reached_m = 9.6;
  return path;
}

PlannedPath blocked(std::size_t cells, std::int64_t utime = kUtime, std::int32_t id = 4) {
  PlannedPath path{utime, id, PlanOutcome::kBlocked, "a beam lies across", {}, 2.1, {}};
  for (std::size_t i = 0; i < cells; ++i) {
    path.blocking.push_back(
        {{0.1 * static_cast<double>(i), 1.0}, BlockingCell::Reason::kRoof, 0.8});
  }
  return path;
}

DrivingState driving(std::int64_t utime = kUtime, std::int32_t id = 4) {
  return {utime, id, DrivingState::Kind::kFailed, "it left the path", 2.5, 7.1, {0.4, -0.01}};
}

template <class Message, class Value>
std::string_view rejection_after(const Value& value, const std::function<void(Message&)>& change) {
  Message message = to_message(value);
  change(message);
  return from_message(message).rejection();
}

TEST(NavigationMessages, SurviveARoundTrip) {
  for (const LaserId laser : {LaserId::kFront, LaserId::kRear}) {
    const ScanRequest request{kUtime, 3, laser};
    EXPECT_EQ(*round_trip(request), request);
  }
  EXPECT_EQ(*round_trip(goal(kUtime)), goal(kUtime));
  const PlanGoal home{
      kUtime, 4, PlanGoal::Kind::kRouteTo, {20.0, -3.0, 0.1}, 12.0, {{12.0, -3.0}, {20.0, -3.0}}};
  EXPECT_EQ(*round_trip(home), home);
  PlanGoal back = goal(kUtime);
  back.kind = PlanGoal::Kind::kRejoin;
  back.route_odom = {{1.0, 2.0}, {3.0, 4.0}};
  back.traversed_path_odom = {{1.0, 2.0, 0.1}, {3.0, 4.0, 0.2}};
  EXPECT_EQ(*round_trip(back), back);
  EXPECT_EQ(*round_trip(found()), found());
  EXPECT_EQ(*round_trip(blocked(3)), blocked(3));
  EXPECT_EQ(*round_trip(driving()), driving());
}

TEST(NavigationMessages, AreRejectedWithImplausibleTimesOrIds) {
  EXPECT_EQ(round_trip(ScanRequest{-1}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(ScanRequest{kUtime, -1}).rejection(), "negative id");
  EXPECT_EQ(round_trip(goal(-1)).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(goal(kUtime, -1)).rejection(), "negative id");
  EXPECT_EQ(round_trip(blocked(1, -1)).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(blocked(1, kUtime, -1)).rejection(), "negative id");
  EXPECT_EQ(round_trip(driving(-1)).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(driving(kUtime, -1)).rejection(), "negative id");
}

TEST(ScanRequestMessage, IsRejectedForAnUnknownLaser) {
  for (const char* laser : {"", "LASER_LEFT", "LASER_FRONT "}) {
    const auto rejection = rejection_after<scan_request_t>(
        ScanRequest{kUtime}, [laser](scan_request_t& m) { m.laser = laser; });
    EXPECT_EQ(rejection, "unknown laser");
  }
}

TEST(PlanGoalMessage, IsRejectedWithAnInvalidGoal) {
  using Message = plan_goal_t;
  const auto rejection = [](const std::function<void(Message&)>& change) {
    return rejection_after<Message>(goal(kUtime), change);
  };
  EXPECT_EQ(rejection([](Message& m) { m.kind = 6; }), "unknown kind");
  for (const std::int8_t kind : {Message::KIND_ROUTE, Message::KIND_ROUTE_TO}) {
    EXPECT_EQ(rejection([&](Message& m) { m.kind = kind; }), "invalid route");
  }
  EXPECT_EQ(rejection([](Message& m) {
              m.route_odom = {{1.0, kNaN}};
              m.n_route = 1;
            }),
            kImplausiblePosition);
  for (const std::int8_t kind : {Message::KIND_RETRACE, Message::KIND_REJOIN}) {
    EXPECT_EQ(rejection([&](Message& m) { m.kind = kind; }), "invalid traversed path");
  }
  EXPECT_EQ(rejection([](Message& m) {
              m.traversed_path_odom = {{1.0, 2.0, kNaN}};
              m.n_traversed_path = 1;
            }),
            kImplausibleHeading);
  EXPECT_EQ(rejection([](Message& m) { m.kind = -1; }), "unknown kind");
  EXPECT_EQ(rejection([](Message& m) { m.T_odom_goal[1] = kNaN; }), kImplausiblePosition);
  EXPECT_EQ(rejection([](Message& m) { m.distance_max_m = kNaN; }), "distance is not positive");
  EXPECT_EQ(rejection([](Message& m) { m.distance_max_m = 0.0; }), "distance is not positive");
}

TEST(PlannedPathMessage, TruncatesBlockingCellsAndKeepsTheirCount) {
  const planned_path_t message = to_message(blocked(10'000));
  const auto bytes = encode(message).size();
  EXPECT_LE(bytes, kFragmentBytes);
  EXPECT_GT(bytes, kFragmentBytes - 100);  // a cell has 25 bytes
  EXPECT_EQ(message.n_blocking_found, 10'000);
  const auto path = from_message(message);
  ASSERT_TRUE(path);
  const auto all = blocked(10'000).blocking;
  EXPECT_TRUE(std::equal(path->blocking.begin(), path->blocking.end(), all.begin()));
}

TEST(PlannedPathMessage, NeverTruncatesThePath) {
  PlannedPath path = found();
  path.points.resize(2000, path.points.front());  // 98 kB
  path.blocking = blocked(10).blocking;
  const planned_path_t message = to_message(path);
  EXPECT_EQ(message.n_points, 2000);
  EXPECT_EQ(message.n_blocking, 0);
  EXPECT_EQ(message.n_blocking_found, 10);
}

TEST(PlannedPathMessage, IsRejectedIfContradictory) {
  using Message = planned_path_t;
  EXPECT_EQ(rejection_after<Message>(found(), [](Message& m) { m.outcome = 6; }),
            "unknown outcome");
  EXPECT_EQ(rejection_after<Message>(found(), [](Message& m) { m.outcome = 2; }),
            "points without a path");
  EXPECT_EQ(rejection_after<Message>(blocked(1), [](Message& m) { m.outcome = 0; }),
            "path without points");
  EXPECT_EQ(rejection_after<Message>(blocked(3), [](Message& m) { m.n_blocking_found = 2; }),
            "cell count below the number of blocking cells");
}

TEST(PlannedPathMessage, IsRejectedWithInvalidNumbers) {
  using Message = planned_path_t;
  const auto rejection = [](const std::function<void(Message&)>& change) {
    return rejection_after<Message>(found(), change);
  };
  EXPECT_EQ(rejection([](Message& m) { m.reached_m = kNaN; }), kInvalidDistance);
  EXPECT_EQ(rejection([](Message& m) { m.points[1].T_odom_body[0] = kNaN; }), kImplausiblePosition);
  EXPECT_EQ(rejection([](Message& m) { m.points[1].curvature_1_m = kNaN; }),
            "implausible curvature");
  EXPECT_EQ(rejection([](Message& m) { m.points[1].clearance_m = kNaN; }), "implausible clearance");
  EXPECT_EQ(rejection([](Message& m) { m.points[1].cost = kNaN; }), "implausible cost");
}

TEST(PlannedPathMessage, IsRejectedWithInvalidBlockingCells) {
  using Message = planned_path_t;
  EXPECT_EQ(
      rejection_after<Message>(blocked(2), [](Message& m) { m.blocking[1].p_odom[0] = kNaN; }),
      kImplausiblePosition);
  EXPECT_EQ(rejection_after<Message>(blocked(2), [](Message& m) { m.blocking[1].reason = 7; }),
            "unknown blocking reason");
  EXPECT_TRUE(rejection_after<Message>(blocked(2), [](Message& m) {
                m.blocking[1].height_m = kNaN;
              }).empty());
}

TEST(DrivingStateMessage, IsRejectedWithInvalidContent) {
  using Message = driving_state_t;
  const auto rejection = [](const std::function<void(Message&)>& change) {
    return rejection_after<Message>(driving(), change);
  };
  EXPECT_EQ(rejection([](Message& m) { m.state = 5; }), "unknown state");
  EXPECT_EQ(rejection([](Message& m) { m.state = -1; }), "unknown state");
  EXPECT_EQ(rejection([](Message& m) { m.progress_m = kNaN; }), "invalid distance");
  EXPECT_EQ(rejection([](Message& m) { m.remaining_m = -0.1; }), "invalid distance");
  EXPECT_EQ(rejection([](Message& m) { m.lateral_error_m = kNaN; }), "implausible lateral error");
  EXPECT_EQ(rejection([](Message& m) { m.heading_error_rad = kNaN; }), "implausible heading error");
}

}  // namespace
}  // namespace adit
