// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_monitor.hpp"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/sim.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

class MissionMonitorTest : public testing::Test {
 protected:
  void publish_time(std::int64_t utime) {
    publish(bus_, channels::kSimTime, to_message(SimTime{utime}));
    bus_.advance_to(utime);
  }
  void all_but_planning_respond(std::int64_t utime) {
    for (const std::string& stage : stage_names()) {
      if (stage == "planning") continue;
      publish(bus_, channels::kSimTimeDone, to_message(SimTimeDone{utime, stage}));
    }
    bus_.advance_to(utime);
  }
  void publish_phase(Phase phase, std::int32_t sequence) {
    MissionPhase published;
    published.utime = kStart;
    published.sequence = sequence;
    published.phase = phase;
    publish(bus_, channels::kPhase, to_message(published));
    bus_.advance_to(bus_.now_utime());
  }

  void publish_scan(std::int64_t utime) {
    CloudFragment scan;
    scan.part.utime = utime;
    publish(bus_, channels::kCloud, to_message(scan));
    bus_.advance_to(bus_.now_utime());
  }
  void publish_request(std::int64_t after_utime, std::vector<std::int64_t> received_utime) {
    publish(bus_, channels::kCloudRequest,
            to_message(CloudRequest{bus_.now_utime(), after_utime, std::move(received_utime)}));
    bus_.advance_to(bus_.now_utime());
  }

  MemoryBus bus_;
  test::ScratchFolder scratch_;
  MissionMonitor monitor_{bus_, scratch_.path() / "phases.tsv", {{3.0, 0.0}, std::nullopt}};
};

TEST_F(MissionMonitorTest, ReportsATimedOutStageOnce) {
  EXPECT_THAT(monitor_.newly_timed_out(0), IsEmpty());
  publish_time(kStart);
  all_but_planning_respond(kStart);
  EXPECT_THAT(monitor_.newly_timed_out(5), IsEmpty());
  EXPECT_THAT(monitor_.newly_timed_out(5 + MissionMonitor::kStageTimeoutUs - 1), IsEmpty());
  EXPECT_THAT(monitor_.newly_timed_out(5 + MissionMonitor::kStageTimeoutUs),
              ElementsAre("planning"));
  EXPECT_THAT(monitor_.newly_timed_out(5 + 3 * MissionMonitor::kStageTimeoutUs), IsEmpty());
}

TEST_F(MissionMonitorTest, DoesNotReportAStageThatRespondsLate) {
  publish_time(kStart);
  all_but_planning_respond(kStart);
  EXPECT_THAT(monitor_.newly_timed_out(0), IsEmpty());
  publish(bus_, channels::kSimTimeDone, to_message(SimTimeDone{kStart, "planning"}));
  bus_.advance_to(kStart);
  EXPECT_THAT(monitor_.newly_timed_out(2 * MissionMonitor::kStageTimeoutUs), IsEmpty());
}

TEST_F(MissionMonitorTest, HasEndedTwoSecondsAfterTheEndedPhase) {
  publish_time(kStart);
  publish_phase(Phase::kExplore, 1);
  EXPECT_FALSE(monitor_.has_ended());
  publish_phase(Phase::kEnded, 2);
  EXPECT_FALSE(monitor_.has_ended());
  publish_time(kStart + 3 * kSecond);
  EXPECT_TRUE(monitor_.has_ended());
}

TEST_F(MissionMonitorTest, EndsWhenTheVolumeMapHasAllScans) {
  publish_time(kStart);
  publish_scan(kStart);
  publish_scan(kStart + kSecond);
  publish_phase(Phase::kEnded, 1);
  publish_time(kStart + 3 * kSecond);
  EXPECT_FALSE(monitor_.has_ended());
  publish_request(kStart + kSecond, {});  // of terrain
  publish_request(0, {kStart + kSecond});
  EXPECT_FALSE(monitor_.has_ended());
  EXPECT_EQ(monitor_.scans_to_store(), 1U);
  publish_request(0, {kStart, kStart + kSecond});
  EXPECT_TRUE(monitor_.has_ended());
}

TEST_F(MissionMonitorTest, EndsAfterATimeWithoutVolumeMap) {
  publish_time(kStart);
  publish_scan(kStart);
  publish_phase(Phase::kEnded, 1);
  publish_time(kStart + 29 * kSecond);
  EXPECT_FALSE(monitor_.has_ended());
  publish_time(kStart + 31 * kSecond);
  EXPECT_TRUE(monitor_.has_ended());
  EXPECT_EQ(monitor_.scans_to_store(), 1U);
}

TEST_F(MissionMonitorTest, ReportsOnceWhatIsNotStored) {
  const auto report = [this](const std::string& stage, Health health) {
    publish(bus_, channels::kHeartbeat,
            to_message(Heartbeat{kStart, stage, std::move(health), 0, 0, 0}));
    bus_.advance_to(bus_.now_utime());
  };
  using Level = Health::Level;
  const Health failing{Level::kFault, "mapping.journal: cannot write: Input/output error"};
  for (int i = 0; i < 2; ++i) {
    report("mapping", {});
    report("mapping", {Level::kDegraded, "map.journal: 20 bytes are damaged"});
    report("mission", {Level::kFault, "the robot is stranded"});
    report("mapping", failing);
  }
  EXPECT_THAT(monitor_.progress().not_stored, ElementsAre("mapping: " + failing.reason));
}

TEST_F(MissionMonitorTest, MeasuresDistancesFromTheFirstStart) {
  std::int64_t utime = kStart;
  const auto publish_truth = [&](double x_m, double z_m) {
    publish(bus_, channels::kTruth, to_message(StampedPose{utime, {x_m, 4.0, 0.0}, {}, z_m}));
    bus_.advance_to(utime += kSecond);
  };
  publish_truth(6.0, -2.0);
  EXPECT_DOUBLE_EQ(monitor_.progress().distance_from_start_m, 5.0);  // 3, 4, 5
  publish_truth(3.0, -2.0);
  EXPECT_DOUBLE_EQ(monitor_.progress().distance_from_start_m, 4.0);
  publish_truth(3.0, 1.0);  // 3 m above the start
  EXPECT_DOUBLE_EQ(monitor_.progress().distance_from_start_m, 5.0);
  EXPECT_DOUBLE_EQ(monitor_.farthest_m(), 5.0);
}

}  // namespace
}  // namespace adit
