// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated robot on a bus is asked for a 3D scan.
#include "procs/scan_assembly/scan_assembly_node.hpp"

#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "adit/pose_t.hpp"

#include "common/bus/channels.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sensing.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/scan_assembly/sweeping_robot.hpp"

namespace adit {
namespace {

class ScanAssemblyNodeTest : public testing::Test {
 protected:
  ScanAssemblyNodeTest() {
    subscribe<cloud_t>(bus_, channels::kCloud, Delivery::queued(100),
                       [this](const CloudFragment& fragment) {
                         ++fragments_;
                         if (auto cloud = assembler_.add(fragment)) clouds_.push_back(*cloud);
                       });
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::latest(),
                           [this](const Heartbeat& heartbeat) { heartbeat_ = heartbeat; });
  }

  void run(double seconds) { robot_.run(seconds); }
  void request(LaserId laser) {
    publish(bus_, channels::kScanRequest, to_message(ScanRequest{bus_.now_utime(), 5, laser}));
  }

  BoxTunnel tunnel_;
  GroundTruthRobot robot_{box_tunnel(tunnel_)};
  MemoryBus& bus_ = robot_.bus();
  NodeHost host_{bus_, {"scan_assembly", "0.1.0", ""}};
  ScanAssemblyNode node_{host_.bus(), with_groundhog_lasers<ScanAssemblyNodeParams>()};
  Heartbeat heartbeat_;
  CloudReassembler assembler_;
  std::vector<Cloud> clouds_;
  int fragments_ = 0;
};

TEST_F(ScanAssemblyNodeTest, PublishesTheCloudOfARequestInTenSeconds) {
  run(1.5);
  request(LaserId::kFront);
  run(10.0);
  ASSERT_EQ(clouds_.size(), 1U);
  const Cloud& cloud = clouds_.front();
  EXPECT_TRUE(cloud.complete);
  EXPECT_EQ(cloud.id, 5);
  EXPECT_EQ(node_.health(), Health{});
  EXPECT_GT(cloud.lines.size(), 230U);
  EXPECT_GT(fragments_, 10);
  EXPECT_GT(heartbeat_.handled, 1000);
  EXPECT_EQ(heartbeat_.dropped, 0);
  EXPECT_EQ(heartbeat_.rejected, 0);
  // Offset, unit and noise of the laser: 15, 5 and 24 mm; a bias of the accelerometers of three
  // times 0.02 m/s² over up to 12 m at steep incidence: 72 mm.
  EXPECT_LE(test::largest_error(tunnel_, cloud), 0.044 + 0.072);
}

TEST_F(ScanAssemblyNodeTest, ScansBackwardsWithTheRearLaser) {
  run(1.5);
  request(LaserId::kRear);
  run(10.0);
  ASSERT_EQ(clouds_.size(), 1U);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const CloudLine& line : clouds_[0].lines) {
    for (const Eigen::Vector3f& p : line.points) sum += p;
  }
  EXPECT_LT(sum.x(), 0.0F);
  EXPECT_EQ(node_.health(), Health{});
}

TEST_F(ScanAssemblyNodeTest, PublishesOneCloudForEachRequest) {
  run(1.5);
  request(LaserId::kFront);
  run(10.0);
  request(LaserId::kFront);
  run(10.0);
  EXPECT_EQ(clouds_.size(), 2U);
}

/// A request is repeated until its cloud arrives.
TEST_F(ScanAssemblyNodeTest, IgnoresRepetitionsOfARequest) {
  run(1.5);
  for (int i = 0; i < 5; ++i) {
    request(LaserId::kFront);
    run(2.0);
    EXPECT_EQ(node_.health(), Health{}) << i;
  }
  run(10.0);
  EXPECT_EQ(clouds_.size(), 1U);
}

TEST_F(ScanAssemblyNodeTest, ResendsAMissingScanAfterTheResendDelay) {
  CloudReassembler resent;
  std::vector<std::int64_t> resent_utime;
  subscribe<cloud_t>(bus_, channels::kCloudResend, Delivery::queued(100),
                     [&](const CloudFragment& fragment) {
                       if (const auto cloud = resent.add(fragment))
                         resent_utime.push_back(cloud->utime);
                     });
  const auto request_missing = [&](const std::vector<std::int64_t>& received) {
    publish(bus_, channels::kCloudRequest, to_message(CloudRequest{bus_.now_utime(), 0, received}));
  };
  run(1.5);
  request(LaserId::kFront);
  while (clouds_.empty()) run(0.1);
  request_missing({});
  EXPECT_TRUE(resent_utime.empty());
  run(3.5);
  request_missing({clouds_[0].utime});
  EXPECT_TRUE(resent_utime.empty());
  request_missing({});
  EXPECT_EQ(resent_utime, (std::vector{clouds_[0].utime}));
}

TEST_F(ScanAssemblyNodeTest, ReportsWhyARequestIsRejected) {
  request(LaserId::kFront);
  EXPECT_EQ(node_.health().level, Health::Level::kDegraded);
  EXPECT_EQ(node_.health().reason, "request rejected: no pose received yet");
}

/// Runs one sweep with a journal and checks that the scan is in the journal when its first fragment
/// is published. Returns the time of the scan.
std::int64_t published_and_stored(const ScanAssemblyNodeParams& params) {
  BoxTunnel tunnel;
  GroundTruthRobot robot{box_tunnel(tunnel)};
  MemoryBus& bus = robot.bus();
  const ScanAssemblyNode node(bus, params);
  std::vector<std::uint8_t> truth;
  std::int64_t published_utime = 0;
  bus.tap([&](const ReceivedMessage& message) {
    if (message.channel == channels::kTruth) {
      truth.assign(message.bytes.begin(), message.bytes.end());
    }
    if (message.channel != channels::kCloud || published_utime != 0) return;
    published_utime = decode<cloud_t>(message.bytes)->utime;
    std::size_t records = 0;
    read_journal(params.journal, [&](const JournalRecord&) { ++records; });
    EXPECT_GT(records, 0U);
  });
  for (int i = 0; i < 1200; ++i) {
    robot.run(0.01);
    bus.publish(channels::kPose, truth);
    if (i == 150) {
      publish(bus, channels::kScanRequest,
              to_message(ScanRequest{bus.now_utime(), 5, LaserId::kFront}));
    }
  }
  return published_utime;
}

TEST(ScanAssemblyNode, StoresAScanBeforeItIsPublishedUntilItIsAcknowledged) {
  const test::ScratchFolder scratch;
  auto params = with_groundhog_lasers<ScanAssemblyNodeParams>();
  params.journal = (scratch / "scans.journal").string();
  const std::int64_t published_utime = published_and_stored(params);
  ASSERT_NE(published_utime, 0);

  MemoryBus bus;  // after a power loss
  std::vector<std::int64_t> resent_utime;
  CloudReassembler assembler;
  subscribe<cloud_t>(bus, channels::kCloudResend, Delivery::queued(100),
                     [&](const CloudFragment& fragment) {
                       if (const auto cloud = assembler.add(fragment))
                         resent_utime.push_back(cloud->utime);
                     });
  const ScanAssemblyNode node(bus, params);
  const auto request_missing = [&](const std::vector<std::int64_t>& received) {
    publish(bus, channels::kCloudRequest, to_message(CloudRequest{bus.now_utime(), 0, received}));
  };
  bus.advance_to(published_utime + 60'000'000);
  request_missing({});
  EXPECT_EQ(resent_utime, std::vector{published_utime});
  EXPECT_GT(std::filesystem::file_size(params.journal), 0U);
  request_missing({published_utime});
  EXPECT_EQ(resent_utime.size(), 1U);
  EXPECT_EQ(std::filesystem::file_size(params.journal), 0U);
}

}  // namespace
}  // namespace adit
