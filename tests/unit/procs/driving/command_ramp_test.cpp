// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/command_ramp.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kTickS = 0.05;

class ARamp : public testing::Test {
 protected:
  void stand(int ticks) {
    for (int i = 0; i < ticks; ++i) ramp_.stand(kTickS);
  }
  void drive(double speed_m_s, double curvature_1_m, int ticks) {
    for (int i = 0; i < ticks; ++i) ramp_.drive(speed_m_s, curvature_1_m, kTickS);
  }

  CommandRamp ramp_{0.2, 0.4};
};

TEST_F(ARamp, GrowsAsFastAsItMayAndSlowsDownAtOnce) {
  stand(10);
  drive(0.3, 0.0, 10);
  EXPECT_NEAR(ramp_.speed_m_s(), 0.1, 1e-9);
  drive(0.3, 0.0, 30);
  EXPECT_NEAR(ramp_.speed_m_s(), 0.3, 1e-9);
  drive(0.1, 0.0, 1);
  EXPECT_NEAR(ramp_.speed_m_s(), 0.1, 1e-9);
  drive(0.1, 0.5, 5);
  EXPECT_NEAR(ramp_.curvature_1_m(), 0.1, 1e-9);
}

TEST_F(ARamp, DrivesOffWhenItHasStoodAndIsSteered) {
  stand(10);
  drive(0.3, 0.6, 27);  // 1.35 s: 0.54 1/m
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
  drive(0.3, 0.6, 2);
  EXPECT_GT(ramp_.speed_m_s(), 0.0);
  stand(2);
  drive(0.3, 0.6, 1);
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
}

TEST_F(ARamp, StandsBeforeItGoesTheOtherWay) {
  stand(10);
  drive(-0.3, 0.0, 20);
  EXPECT_NEAR(ramp_.speed_m_s(), -0.2, 1e-9);
  drive(0.3, 0.0, 1);
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
  EXPECT_FALSE(ramp_.has_stood());
  drive(0.3, 0.0, 6);
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
  drive(0.3, 0.0, 2);
  EXPECT_GT(ramp_.speed_m_s(), 0.0);
}

}  // namespace
}  // namespace adit
