// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map_node.hpp"

#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/volume.hpp"
#include "tests/unit/procs/volume_map/swept_tunnel.hpp"

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

class VolumeMapNodeOnABus : public testing::Test {
 protected:
  VolumeMapNodeOnABus() {
    subscribe<volume_t>(bus_, channels::kVolume, Delivery::queued(100),
                        [this](const VolumeFragment& fragment) {
                          if (is_pose_only(fragment)) {
                            poses_.push_back(fragment.part);
                          } else if (const auto volume = assembler_.add(fragment)) {
                            volumes_.push_back(*volume);
                          }
                        });
  }

  void send_cloud(std::int32_t id, double x, std::string_view channel = channels::kCloud) {
    Cloud cloud = test::sweep_of_tunnel({x, 0.0, 0.0}, 20);
    cloud.id = id;
    cloud.utime = kUtime + id;
    for (const CloudFragment& fragment : split(cloud)) publish(bus_, channel, to_message(fragment));
  }
  void send_graph(std::int64_t revision, std::vector<Pose2> poses) {
    const int newest = static_cast<int>(poses.size()) - 1;
    for (const PoseGraphFragment& fragment : split({kUtime, revision, std::move(poses), {}})) {
      publish(bus_, channels::kPoseGraph, to_message(fragment));
    }
    publish(bus_, channels::kMapCorrection,
            to_message(MapCorrection{kUtime, revision, 0, newest, {}, {}}));
  }

  void send_odom_epoch(std::int64_t utime) {
    ScanMatch match;
    match.utime = utime + 15;
    match.odom_epoch_utime = utime;
    publish(bus_, channels::kScanMatch, to_message(match));
  }

  MemoryBus bus_;
  VolumeMapNode node_{bus_, VolumeMapNodeParams{}};
  VolumeReassembler assembler_;
  std::vector<Volume> volumes_;
  std::vector<Volume> poses_;
};

TEST_F(VolumeMapNodeOnABus, PublishesASubVolumeAfterEachCloud) {
  send_graph(1, {{}});
  EXPECT_TRUE(volumes_.empty());
  send_cloud(1, 0.0);
  send_cloud(2, 1.0);
  ASSERT_EQ(volumes_.size(), 2U);
  EXPECT_EQ(volumes_[0].utime, kUtime + 1);
  EXPECT_EQ(volumes_[0].revision, 1);
  EXPECT_EQ(volumes_[1].id, 0);
  EXPECT_EQ(volumes_[1].revision, 2);
  EXPECT_EQ(volumes_[1].graph_revision, 1);
  EXPECT_EQ(volumes_[1].octree, node_.map().volumes()[0].volume.octree());
  EXPECT_GT(volumes_[1].occupied, 100);
  EXPECT_TRUE(poses_.empty());
  EXPECT_EQ(node_.health(), Health{});
}

TEST_F(VolumeMapNodeOnABus, PublishesAllSubVolumesAfterTheFirstGraph) {
  send_cloud(1, 0.0);
  send_cloud(2, 12.0);
  EXPECT_TRUE(volumes_.empty());
  send_graph(1, {{}});
  ASSERT_EQ(volumes_.size(), 2U);
  EXPECT_EQ(volumes_[1].T_map_volume, (Pose2{12.0, 0.0, 0.0}));
}

TEST_F(VolumeMapNodeOnABus, PublishesOnlyPosesWhenTheGraphMoves) {
  send_graph(1, {{}});
  send_cloud(1, 0.0);
  send_graph(2, {{}, {12.0, 0.0, 0.0}});
  EXPECT_TRUE(poses_.empty());  // the first one does not move
  send_cloud(2, 12.0);
  send_graph(3, {{}, {12.0, 0.5, 0.0}});
  EXPECT_EQ(volumes_.size(), 2U);
  ASSERT_EQ(poses_.size(), 1U);
  EXPECT_EQ(poses_[0].id, 1);
  EXPECT_EQ(poses_[0].local_map, 1);
  EXPECT_EQ(poses_[0].graph_revision, 3);
  EXPECT_EQ(poses_[0].T_map_volume, (Pose2{12.0, 0.5, 0.0}));
}

TEST_F(VolumeMapNodeOnABus, RequestsMissedScans) {
  CloudRequest last_request;
  subscribe<cloud_request_t>(bus_, channels::kCloudRequest, Delivery::latest(),
                             [&](const CloudRequest& request) { last_request = request; });
  send_odom_epoch(kUtime);
  send_graph(1, {{}});
  send_cloud(1, 0.0);
  send_cloud(3, 2.0);
  bus_.advance_to(kUtime);
  EXPECT_EQ(last_request.received_utime, (std::vector{kUtime + 1, kUtime + 3}));
  send_cloud(2, 1.0, channels::kCloudResend);
  bus_.advance_to(kUtime + 2'000'000);
  EXPECT_EQ(last_request.received_utime, (std::vector{kUtime + 1, kUtime + 3, kUtime + 2}));
  ASSERT_EQ(volumes_.size(), 3U);
  EXPECT_EQ(volumes_.back().revision, 3);
  EXPECT_EQ(volumes_.back().utime, kUtime + 3);  // of its newest scan
}

TEST_F(VolumeMapNodeOnABus, ExcludesScansOfAnUnknownOdomFrame) {
  CloudRequest last_request;
  subscribe<cloud_request_t>(bus_, channels::kCloudRequest, Delivery::latest(),
                             [&](const CloudRequest& request) { last_request = request; });
  send_odom_epoch(kUtime + 5);
  send_graph(1, {{}});
  bus_.advance_to(kUtime + 2'000'000);
  EXPECT_EQ(last_request.after_utime, kUtime + 4);  // earlier scans are not requested
  send_cloud(3, 0.0, channels::kCloudResend);
  EXPECT_EQ(node_.map().excluded(), 1);
  EXPECT_TRUE(volumes_.empty());
  send_cloud(5, 0.0, channels::kCloudResend);
  EXPECT_EQ(volumes_.size(), 1U);
}

TEST_F(VolumeMapNodeOnABus, InsertsAScanOnce) {
  send_graph(1, {{}});
  send_cloud(1, 0.0);
  send_cloud(1, 0.0, channels::kCloudResend);
  EXPECT_EQ(volumes_.size(), 1U);
  EXPECT_EQ(node_.map().volumes()[0].volume.scans(), 1);
}

TEST_F(VolumeMapNodeOnABus, ReportsAnIncompleteCloud) {
  Cloud cloud = test::sweep_of_tunnel({}, 5);
  cloud.complete = false;
  for (const CloudFragment& fragment : split(cloud)) {
    publish(bus_, channels::kCloud, to_message(fragment));
  }
  EXPECT_EQ(node_.health().level, Health::Level::kDegraded);
}

}  // namespace
}  // namespace adit
