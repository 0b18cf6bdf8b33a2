// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/scan_input.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/sensing.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "tests/support/robots/simulated_robot.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/plan/swept_scan.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

class ScanInputs : public testing::Test {
 protected:
  void write(const std::vector<Cloud>& clouds, std::size_t drop_fragment = 1000) {
    LogWriter log(file_);
    for (const Cloud& cloud : clouds) {
      std::size_t number = 0;
      for (const CloudFragment& fragment : split(cloud)) {
        if (number++ == drop_fragment) continue;
        log.write({cloud.utime, channels::kCloud, encode(to_message(fragment))});
      }
    }
    log.close();
  }

  [[nodiscard]] std::string error_text() const {
    try {
      (void)scans_of_log(file_, {});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "scans.lcmlog";
};

/// A minimal scan.
Cloud scan(int id, bool complete = true) {
  Cloud cloud;
  cloud.utime = 1'000'000 * (id + 1);
  cloud.id = id;
  cloud.complete = complete;
  cloud.lines.resize(1);
  cloud.lines[0].points = {{1.0F, 2.0F, static_cast<float>(id)}};
  return cloud;
}

std::vector<int> ids(const std::vector<NumberedScan>& scans) {
  std::vector<int> result;
  for (const NumberedScan& chosen : scans) result.push_back(chosen.cloud.id);
  return result;
}

TEST_F(ScanInputs, SelectsAmongTheScansOfALog) {
  write({scan(3, false), scan(5), scan(9)});
  const ScanInput source = scans_of_log(file_, {});
  ASSERT_EQ(source.clouds.size(), 3U);
  EXPECT_EQ(ids(select_scans(source, {})), (std::vector<int>{5}));  // the first that is complete
  EXPECT_EQ(ids(select_scans(source, {.number = 1})), (std::vector<int>{3}));
  EXPECT_EQ(ids(select_scans(source, {.id = 9})), (std::vector<int>{9}));
  EXPECT_EQ(ids(select_scans(source, {.all = true})), (std::vector<int>{3, 5, 9}));
  EXPECT_THROW(select_scans(source, {.number = 4}), std::runtime_error);
  EXPECT_THROW(select_scans(source, {.id = 4}), std::runtime_error);
  write({scan(3, false)});
  EXPECT_EQ(ids(select_scans(scans_of_log(file_, {}), {})), (std::vector<int>{3}));
}

TEST_F(ScanInputs, ReportsMissingChannels) {
  write({test::swept_tunnel(true)}, 1);
  EXPECT_THAT(error_text(), HasSubstr("scans.lcmlog: no 3D scan"));
  EXPECT_THAT(error_text(), HasSubstr("missing: SCAN_REQUEST, LASER_FRONT, TILT_FRONT, POSE"));
}

/// Records the messages of drivers, scan matching and scan requests during a sweep; returns the
/// assembled scan.
Cloud record_sweep(const std::filesystem::path& file) {
  GroundTruthRobot robot(box_tunnel());
  MemoryBus& bus = robot.bus();
  LogWriter log(file);
  for (const auto channel : {channels::kLaserFront, channels::kTiltFront, channels::kPose,
                             channels::kImu, channels::kScanRequest, channels::kTiltCommandFront}) {
    bus.subscribe(channel, Delivery::queued(1000), [&](const ReceivedMessage& received) {
      log.write({bus.now_utime(), received.channel, received.bytes});
      return std::string_view();
    });
  }
  const ScanAssemblyNode node(bus, with_groundhog_lasers<ScanAssemblyNodeParams>());
  CloudReassembler assembler;
  Cloud swept;
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(1000),
                     [&](const CloudFragment& fragment) {
                       if (const auto cloud = assembler.add(fragment)) swept = *cloud;
                     });
  robot.run(1.5);
  publish(bus, channels::kScanRequest,
          to_message(ScanRequest{bus.now_utime(), 1, LaserId::kFront}));
  robot.run(10.0);
  log.close();
  return swept;
}

TEST_F(ScanInputs, AssemblesAScanFromTheMessagesOfASweep) {
  const Cloud live = record_sweep(file_);
  const ScanInput source = scans_of_log(file_, {});
  ASSERT_EQ(source.clouds.size(), 1U);
  const Cloud& repeated = source.clouds[0];
  EXPECT_THAT(source.warnings, testing::ElementsAre(HasSubstr("those of Groundhog")));
  EXPECT_TRUE(repeated.complete);
  EXPECT_GT(repeated.points(), 50'000U);
  ASSERT_EQ(repeated.lines.size(), live.lines.size());
  for (std::size_t i = 0; i < live.lines.size(); ++i) {
    EXPECT_EQ(repeated.lines[i].points, live.lines[i].points) << i;
  }
}

}  // namespace
}  // namespace adit
