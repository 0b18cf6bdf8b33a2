// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/limit_checks.hpp"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(AirReason, AppliesBeyondTheLimits) {
  const AirParams limits;
  EXPECT_EQ(air_reason({}, limits), std::nullopt);
  EXPECT_EQ(air_reason({0, 0.0099, 0.195, 50e-6}, limits), std::nullopt);
  EXPECT_EQ(air_reason({0, 0.0125, 0.1, 1e-3}, limits), "methane 1.25 %, limit 1.00 %");
  EXPECT_EQ(air_reason({0, 0.0, 0.18, 1e-3}, limits), "oxygen 18.00 %, limit 19.50 %");
  EXPECT_EQ(air_reason({0, 0.0, 0.2, 1e-3}, limits), "carbon monoxide 1000 ppm, limit 50 ppm");
}

TEST(SinkageReason, NamesTheDeepestWheel) {
  EXPECT_EQ(sinkage_reason({0, {0.1, 0.15, 0.0, 0.0}}, 0.15), std::nullopt);
  EXPECT_EQ(sinkage_reason({0, {0.1, 0.0, 0.17, 0.16}}, 0.15),
            "rear left wheel sunk in by 0.17 m, limit 0.15 m");
}

TEST(TiltReason, AppliesToRollAndPitchToEitherSide) {
  const auto up_body = [](double x, double y) {
    return Eigen::Vector3d(x, y, std::sqrt(1.0 - x * x - y * y));
  };
  EXPECT_EQ(tilt_reason(up_body(0.38, 0.0), 0.4), std::nullopt);
  EXPECT_EQ(tilt_reason(up_body(std::sin(0.42), 0.0), 0.4), "pitch of 0.42 rad, limit 0.40 rad");
  EXPECT_EQ(tilt_reason(up_body(-std::sin(0.42), 0.0), 0.4), "pitch of -0.42 rad, limit 0.40 rad");
  EXPECT_EQ(tilt_reason(up_body(0.0, std::sin(0.42)), 0.4), "roll of 0.42 rad, limit 0.40 rad");
  EXPECT_EQ(tilt_reason(up_body(0.0, -std::sin(0.42)), 0.4), "roll of -0.42 rad, limit 0.40 rad");
}

}  // namespace
}  // namespace adit
