// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/carmen/carmen_line.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace adit {
namespace {

std::string flaser(int beams) {
  std::string line = "FLASER " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " 1.5";
  return line + " 1 2 0.5 3 4 -0.5 12.345678 host 99.5";
}

std::string_view reason(const std::string& line) {
  const CarmenLine result = parse_carmen_line(line);
  const auto* rejected = std::get_if<CarmenError>(&result);
  return rejected != nullptr ? rejected->reason : "";
}

TEST(CarmenLine, ReadsFlaser) {
  const auto result = std::get<CarmenScan>(
      parse_carmen_line("FLASER 3 1.00 nan 81.83 1 2 0.5 3 4 -0.5 1134864629.895182 b21 0.0863\r"));
  EXPECT_EQ(result.scan.utime, 1134864629895182);
  ASSERT_EQ(result.scan.ranges_m.size(), 3U);
  EXPECT_FLOAT_EQ(result.scan.ranges_m[0], 1.0F);
  EXPECT_TRUE(std::isnan(result.scan.ranges_m[1]));
  EXPECT_FLOAT_EQ(result.scan.ranges_m[2], 81.83F);
  EXPECT_EQ(result.T_log_laser, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_EQ(result.odometry.T_wheel_body, (Pose2{3.0, 4.0, -0.5}));
  EXPECT_EQ(result.odometry.utime, result.scan.utime);
}

TEST(CarmenLine, DerivesTheAnglesOfFlaserFromTheNumberOfBeams) {
  for (const int beams : {180, 181, 360, 361}) {
    const auto result = std::get<CarmenScan>(parse_carmen_line(flaser(beams)));
    EXPECT_DOUBLE_EQ(result.scan.angle_min_rad, deg_to_rad(-90.0));
    EXPECT_DOUBLE_EQ(result.scan.angle_step_rad, deg_to_rad(beams < 300 ? 1.0 : 0.5)) << beams;
  }
}

TEST(CarmenLine, ReadsRobotLaserWithItsOwnAngles) {
  const auto result = std::get<CarmenScan>(
      parse_carmen_line("ROBOTLASER1 0 -2.0 4.0 2.0 30 0.01 0 3 1 2 3 2 0.1 0.2 "
                        "5.5 6 0.1 5 6 0.2 0 0 0.3 0.3 0.6 7.5 host 8.5"));
  EXPECT_DOUBLE_EQ(result.scan.angle_min_rad, -2.0);
  EXPECT_DOUBLE_EQ(result.scan.angle_step_rad, 2.0);
  EXPECT_EQ(result.scan.ranges_m, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(result.T_log_laser, (Pose2{5.5, 6.0, 0.1}));
  EXPECT_EQ(result.odometry.T_wheel_body, (Pose2{5.0, 6.0, 0.2}));
  EXPECT_EQ(result.scan.utime, 7500000);
}

TEST(CarmenLine, ReadsOdom) {
  const auto result =
      std::get<CarmenOdometry>(parse_carmen_line("ODOM 1 -2 3e-1 0 0 0 0.313517 pippo 0.3"));
  EXPECT_EQ(result.odometry.T_wheel_body, (Pose2{1.0, -2.0, 0.3}));
  EXPECT_EQ(result.odometry.utime, 313517);
  EXPECT_EQ(result.times.measured_utime, 313517);
  EXPECT_EQ(result.times.logged_utime, 300000);
}

TEST(CarmenLine, MarksTimestampsThatAreNotPositive) {
  for (const char* line : {"ODOM 0 0 0 0 0 0 0 pippo -5", "ODOM 0 0 0 0 0 0 1.5e-52 pippo 1e300"}) {
    const auto result = std::get<CarmenOdometry>(parse_carmen_line(line));
    EXPECT_EQ(result.times.measured_utime, 0) << line;
    EXPECT_EQ(result.times.logged_utime, 0) << line;
  }
}

TEST(CarmenLine, IgnoresOtherLines) {
  for (const char* line :
       {"", "   ", "# FLASER", "NEFF 30", "PARAM a b", "RAWLASER1 0", "odom 1"}) {
    EXPECT_TRUE(std::holds_alternative<CarmenIgnored>(parse_carmen_line(line))) << line;
  }
}

TEST(CarmenLine, RejectsACountThatExceedsTheLine) {
  EXPECT_EQ(reason("FLASER 1000000000 1 2 3"), "fewer readings than the count in the line");
  EXPECT_EQ(reason("FLASER 99999999999999999999 1 2"), "malformed number");
  EXPECT_EQ(reason("FLASER -4 1 2"), "malformed number");
  EXPECT_EQ(reason("FLASER 0 1 2 0.5 3 4 -0.5 12.3 host 99.5"), "fewer than two readings");
  EXPECT_EQ(reason("ROBOTLASER1 0 -2 4 2 30 0.01 0 2 1 2 900000000000 1"),
            "fewer readings than the count in the line");
}

TEST(CarmenLine, RejectsEveryTruncationOfALine) {
  const std::string line = flaser(5);
  for (std::size_t end = line.find(' '); end != std::string::npos; end = line.find(' ', end + 1)) {
    EXPECT_NE(reason(line.substr(0, end)), "") << line.substr(0, end);
  }
}

TEST(CarmenLine, RejectsInvalidValues) {
  EXPECT_EQ(reason("FLASER 2 1 x 0 0 0 0 0 0 1 host 1"), "malformed number");
  EXPECT_EQ(reason("FLASER 2 1 1 nan 0 0 0 0 0 1 host 1"), "value not finite");
  EXPECT_EQ(reason("FLASER 2 1 1 0 0 0 0 0 0 1 host 1 2"), "excess tokens at the end of the line");
  EXPECT_EQ(reason("ODOM 0 0 0 0 0 0 1e300 pippo 0"), "implausible timestamp");
  EXPECT_EQ(reason("ROBOTLASER1 0 -2 4 0 30 0.01 0 2 1 2 0 0 0 0 0 0 0 0 0 0 0 0 1 h 1"),
            "angular step not positive");
}

}  // namespace
}  // namespace adit
