// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/full_map.hpp"

#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/sensing.hpp"
#include "tools/map/map_files.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;
constexpr int kScans = 5;  // per local map, 1 m apart; consecutive maps share one

LaserScan scan_at(int second) {
  return {kStart + second * kSecond, std::vector<float>(3, 2.0F), -0.1, 0.1};
}

/// A local map of a straight path along x of odom, 1 m per second from `first_second`.
LocalMap local_map(int id, int session, int first_second, double x_odom) {
  LocalMap map;
  map.id = id;
  map.session = session;
  map.T_odom_local = {x_odom, 0.0, 0.0};
  map.T_previous_local = {kScans - 1.0, 0.0, 0.0};
  map.information = Eigen::Matrix3d::Identity();
  for (int i = 0; i < kScans; ++i) {
    map.scans.push_back({"LASER_FRONT", scan_at(first_second + i), {1.0 * i, 0.0, 0.0}});
  }
  map.utime = map.scans.front().scan.utime;
  map.end_utime = map.scans.back().scan.utime;
  return map;
}

Association association(int loop_closure, int newer, int older, int chosen, int before) {
  Association a;
  a.utime = kStart;
  a.action = before == Association::kNone && chosen != Association::kNone
                 ? Association::Action::kProposed
                 : Association::Action::kRevised;
  a.loop_closure = {
      loop_closure, newer, {{older, {1.0, 0.0, 0.0}, Eigen::Matrix3d::Identity(), 7.0}}};
  a.chosen = chosen;
  a.previously_chosen = before;
  a.reason = "test";
  return a;
}

/// Maps 0 and 1 of an earlier session; the recorded run adds map 2 and 1 m of path after it.
class FullMapTest : public testing::Test {
 protected:
  FullMapTest() {
    earlier_.maps.push_back(local_map(0, 0, 0, 0.0));
    earlier_.maps.push_back(local_map(1, 0, 4, 4.0));
    earlier_.associations = {association(0, 1, 0, 0, Association::kNone)};
    for (int i = 0; i <= kScans; ++i) {
      send(100 + i, channels::kLaserFront, to_message(scan_at(100 + i)));
      ScanMatch match;
      match.utime = kStart + (100 + i) * kSecond;
      match.channel = channels::kLaserFront;
      match.status = i == 0 ? ScanMatch::Status::kFirstScan : ScanMatch::Status::kMatched;
      match.T_odom_body = {1.0 * i, 0.0, 0.0};
      send(100 + i, channels::kScanMatch, to_message(match));
    }
    for (const auto& fragment : split(local_map(2, 1, 100, 0.0))) {
      send(106, channels::kLocalMap, to_message(fragment));
    }
    send(106, channels::kAssociation, to_message(association(1, 2, 0, 0, Association::kNone)));
    send(106, channels::kAssociation, to_message(association(0, 1, 0, Association::kNone, 0)));
    MapGraph graph;
    graph.utime = kStart + 106 * kSecond;
    graph.revision = 1;
    graph.poses = {{0, 0, 0}, {4, 1, 0}, {0, 3, 0}};
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    graph.constraints = {{{0, 1, {4, 0, 0}, one}, MapConstraint::Kind::kSequential},
                         {{1, 2, {4, 0, 0}, one}, MapConstraint::Kind::kSequential},
                         {{0, 2, {0, 3, 0}, one}, MapConstraint::Kind::kLoopClosure}};
    for (const auto& fragment : split(graph)) send(106, channels::kPoseGraph, to_message(fragment));
    map_ = full_map(earlier_, record_);
  }

  template <class Message>
  void send(int second, std::string_view channel, const Message& message) {
    bus_.inject(kStart + second * kSecond, channel, encode(message));
  }

  MemoryBus bus_;
  RunRecord record_{bus_};
  EarlierMap earlier_;
  FullMap map_;
};

TEST_F(FullMapTest, HasBothRunsInOneFrame) {
  ASSERT_EQ(map_.local_maps.size(), 3U);
  ASSERT_EQ(map_.paths.size(), 2U);
  EXPECT_EQ(map_.paths[0].size(), 2U * kScans - 1U);  // consecutive maps share a scan
  EXPECT_EQ(map_.paths[1].size(), kScans + 1U);
  std::size_t scans = 0;
  EXPECT_TRUE(map_.visit_scans(map_, [&](const PlacedScan&) { return ++scans > 0; }));
  EXPECT_EQ(scans, 3U * kScans + 1U);
  const Trajectory path = joined_path(map_);
  ASSERT_EQ(path.size(), 3U * kScans);
  EXPECT_EQ(path[4].pose, (Pose2{4, 1, 0}));
  EXPECT_EQ(path[8].pose, (Pose2{8, 1, 0}));
  EXPECT_EQ(path.back().pose, (Pose2{5, 3, 0}));  // after the last local map
  EXPECT_EQ(count_cross_session_loop_closures(map_), 1U);
}

TEST_F(FullMapTest, UsesTheLaterSessionForPosesOfTheSameTime) {
  Spool<TimedPose> later;
  for (TimedPose pose : map_.paths[1]) {
    if (later.empty()) pose.utime = map_.paths[0].front().utime;
    later.push_back(pose);
  }
  map_.paths[1] = std::move(later);
  const Trajectory path = joined_path(map_);
  EXPECT_EQ(path.size(), 3U * kScans - 1U);
  EXPECT_EQ(path.front().pose, (Pose2{0, 3, 0}));
}

TEST_F(FullMapTest, KeepsScansAfterTheLastLocalMap) {
  ASSERT_EQ(record_.tail().size(), 1U);
  EXPECT_EQ(record_.tail().front().scan.utime, scan_at(105).utime);
  EXPECT_EQ(record_.odometry().size(), kScans + 1U);
}

TEST_F(FullMapTest, DrawsAcceptedAndRevokedLoopClosures) {
  const GraphPicture picture = graph_picture(map_);
  EXPECT_EQ(picture.nodes, map_.graph.poses);
  EXPECT_EQ(picture.sequential.size(), 1U) << "no edge between sessions";
  ASSERT_EQ(picture.loop_closures.size(), 1U);
  EXPECT_EQ(picture.loop_closures[0].b, Eigen::Vector2d(0, 3));
  ASSERT_EQ(picture.revoked.size(), 1U);
  EXPECT_EQ(picture.revoked[0].b, Eigen::Vector2d(4, 1));
}

TEST_F(FullMapTest, DoesNotDrawReacceptedLoopClosuresAsRevoked) {
  const Association reaccepted = association(0, 1, 0, 0, Association::kNone);
  map_.associations.push_back(&reaccepted);
  EXPECT_TRUE(graph_picture(map_).revoked.empty());
}

TEST_F(FullMapTest, ListsDecisionsInOrderOfTime) {
  const std::string table = association_table(map_);
  const std::string first =
      "1600000000.000000\taccepted\t0\t1\t0\t1\tnone\t1\t1.000\t0.000\t0.00\t7.0";
  EXPECT_THAT(table, testing::StartsWith("time_s\tdecision\tloop_closure\t"));
  EXPECT_THAT(table, HasSubstr("\n" + first));
  EXPECT_THAT(table, HasSubstr("\trevoked\t0\t1\t0\tnone\t1\t"));
  EXPECT_LT(table.find("accepted\t1\t"), table.find("revoked\t0\t"));
  EXPECT_THAT(table, testing::EndsWith("\ttest\n"));
}

}  // namespace
}  // namespace adit
