// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/level_correction.hpp"

#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/unit/tools/survey/survey_scene.hpp"

namespace adit {
namespace {

/// A scan of a tunnel along x, by a robot at `x` with a heading, whose level frame is inclined.
Cloud inclined_scan(double x, double heading_rad, const Eigen::Matrix3d& tilt) {
  Cloud cloud = test::scan_of_tunnel(-8.0, 8.0);
  const LevelPose T_level_world = LevelPose{{x, 0.0, heading_rad}, 0.0}.inverse();
  for (CloudLine& line : cloud.lines) {
    for (Eigen::Vector3f& p : line.points)
      p = (tilt * (T_level_world * Eigen::Vector3d(p.cast<double>()))).cast<float>();
  }
  return cloud;
}

class InclinedScans : public testing::Test {
 protected:
  LevelCorrection correction_of(const std::vector<double>& headings) {
    CloudStore clouds;
    std::vector<LeveledScan> scans;
    for (const double heading : headings) {
      scans.push_back({clouds.size(), 0, {{0.0, 0.0, heading}, 0.0}});
      clouds.push_back(inclined_scan(0.0, heading, tilt_));
    }
    return LevelCorrection(clouds, scans);
  }

  const Eigen::Matrix3d tilt_ = (Eigen::AngleAxisd(0.002, Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(-0.006, Eigen::Vector3d::UnitY()))
                                    .toRotationMatrix();
};

TEST_F(InclinedScans, OfOppositeHeadingsAreLeveled) {
  const LevelCorrection correction = correction_of({0.0, 3.1, 0.1, -3.0});
  const Eigen::Matrix3d rest = correction.rotation(0) * tilt_;
  EXPECT_LT(Eigen::AngleAxisd(rest).angle(), 0.0015);  // 0.0063 before; the prior pulls to zero
  EXPECT_LT(correction.sd_rad(0), 0.004);
}

TEST_F(InclinedScans, OfOneHeadingShowNothing) {
  const LevelCorrection correction = correction_of({0.0, 0.1, 0.05});
  EXPECT_TRUE(correction.rotation(0).isIdentity(1e-12));
  EXPECT_GT(correction.sd_rad(0), 0.005);
}

}  // namespace
}  // namespace adit
