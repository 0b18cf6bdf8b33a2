// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_import.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/sensing.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/carmen/carmen_line.hpp"

namespace adit {
namespace {

using testing::ElementsAre;

CarmenScan example() {
  CarmenScan scan;
  scan.scan = {1134864629895182, {1.25F, 81.83F, 0.0F}, deg_to_rad(-90.0), deg_to_rad(90.0)};
  scan.T_log_laser = {1.0, -2.0, 0.25};
  scan.odometry = {scan.scan.utime, {3.0, 4.0, -3.125}};
  return scan;
}

TEST(CarmenLine, RoundTripsAFlaserLine) {
  const auto read = std::get<CarmenScan>(parse_carmen_line(flaser_line(example())));
  EXPECT_EQ(read.scan, example().scan);
  EXPECT_EQ(read.T_log_laser, example().T_log_laser);
  EXPECT_EQ(read.odometry.T_wheel_body, example().odometry.T_wheel_body);
}

TEST(CarmenImport, PublishesOdometryThenScanWithTheirTimes) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "adit_import.log") << flaser_line(example()) << "\n";
  const CarmenReport report =
      import_carmen(folder / "adit_import.log", folder / "adit_import.lcmlog", [](double) {});
  EXPECT_EQ(report.scans, 1U);

  LogFile log(folder / "adit_import.lcmlog");
  const auto odometry = log.next();
  const auto scan = log.next();
  ASSERT_TRUE(odometry && scan);
  EXPECT_FALSE(log.next());
  EXPECT_EQ(odometry->channel, channels::kWheelOdometry);
  EXPECT_EQ(scan->channel, channels::kLaserFront);
  EXPECT_EQ(odometry->utime, example().scan.utime);
  EXPECT_EQ(scan->utime, example().scan.utime);
  const auto message = decode<planar_lidar_t>(scan->data);
  ASSERT_TRUE(message);
  EXPECT_EQ(from_message(*message)->ranges_m, example().scan.ranges_m);
}

TEST(CarmenImport, WritesReadingsInOrderOfTime) {
  const test::ScratchFolder folder;
  std::ofstream text(folder / "exchanged.log");
  for (int i = 0; i < 50; ++i) {
    CarmenScan scan = example();
    scan.scan.utime += 100'000 * (i ^ 3);  // groups of four are reversed
    scan.odometry.utime = scan.scan.utime;
    text << flaser_line(scan) << "\n";
  }
  text.close();
  import_carmen(folder / "exchanged.log", folder / "exchanged.lcmlog", [](double) {});
  LogReader log(folder / "exchanged.lcmlog");  // in the order of the file
  std::int64_t last = 0;
  int events = 0;
  while (const auto event = log.next()) {
    EXPECT_GE(event->utime, last);
    last = event->utime;
    ++events;
  }
  EXPECT_EQ(events, 100);
}

}  // namespace
}  // namespace adit
