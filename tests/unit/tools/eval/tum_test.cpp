// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

Trajectory parse(const std::string& text) {
  std::istringstream in(text);
  return read_tum(in, "t.tum");
}

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Tum, WritesFixedDigits) {
  std::ostringstream out;
  write_tum(out, {{1134864629000005, {1.5, -2.0, 0.0}}});
  EXPECT_EQ(out.str(),
            "1134864629.000005 1.500000000 -2.000000000 0 0 0 0.000000000000 1.000000000000\n");
}

TEST(Tum, ReadsWrittenTrajectories) {
  const Trajectory written{{1134864629895182, {1.25, -2.5, 3.1}},
                           {1134864629995182, {99, 4, -3.1}}};
  std::ostringstream out;
  write_tum(out, written);
  const Trajectory read = parse("# time x y z qx qy qz qw\n\n" + out.str());
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].utime, written[i].utime);
    EXPECT_NEAR((read[i].pose.vector() - written[i].pose.vector()).norm(), 0.0, 1e-8);
  }
}

TEST(Tum, KeepsHeights) {
  const Trajectory written{{1134864629895182, {1.25, -2.5, 3.1}, 0.0},
                           {1134864629995182, {99, 4, -3.1}, -7.25}};
  std::ostringstream out;
  write_tum(out, written);
  const Trajectory read = parse(out.str());
  EXPECT_EQ(read.at(0).z_m, 0.0);
  EXPECT_EQ(read.at(1).z_m, -7.25);
  EXPECT_NEAR(interpolate_in_space(read, 1134864629945182)->z_m, -3.625, 1e-9);
}

TEST(Tum, ReadsTheYawOfATiltedPose) {
  // A roll of 90° before a yaw of 60°: q = (0, 0, sin 30°, cos 30°) ⊗ (sin 45°, 0, 0, cos 45°).
  const Trajectory read = parse("1 0 0 0 0.612372436 0.353553391 0.353553391 0.612372436");
  EXPECT_NEAR(rad_to_deg(read.at(0).pose.theta), 60.0, 1e-6);
}

TEST(Tum, ReportsTheLineOfAnError) {
  const std::string good = "1 0 0 0 0 0 0 1\n";
  EXPECT_EQ(error_of(good + "2 0 0 0 0 0 1\n"), "t.tum:2: expected 8 numbers, found 7");
  EXPECT_EQ(error_of(good + "2 0 x 0 0 0 0 1\n"), "t.tum:2: 'x' is not a finite number");
  EXPECT_EQ(error_of(good + "2 0 nan 0 0 0 0 1\n"), "t.tum:2: 'nan' is not a finite number");
  EXPECT_EQ(error_of(good + "\n" + good), "t.tum:3: the time does not increase");
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 2\n"), "t.tum:1: the quaternion has no unit length");
}

TEST(Tum, RejectsAMissingFile) { EXPECT_THROW(read_tum("/nonexistent.tum"), std::runtime_error); }

}  // namespace
}  // namespace adit
