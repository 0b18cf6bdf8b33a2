// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/wheel_slip.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

double mean_product(const std::vector<double>& values, double mean, std::size_t shift) {
  double sum = 0.0;
  for (std::size_t i = 0; i + shift < values.size(); ++i) {
    sum += (values[i] - mean) * (values[i + shift] - mean);
  }
  return sum / static_cast<double>(values.size() - shift);
}

TEST(WheelSlip, VariesAboutItsMeanOverAMetre) {
  VehicleModelParams params;
  params.slip_share = 0.3;  // so that nothing is clamped at 0
  params.slip_sd = 0.02;
  WheelSlip slip(params, 5);
  std::vector<double> lost;
  double sum = 0.0;
  constexpr int kPerMetre = 20;
  for (int i = 0; i < 20'000 * kPerMetre; ++i) {
    slip.advance(1.0 / kPerMetre);
    lost.push_back(slip.slip_ratio(0.0));
    sum += lost.back();
  }
  const double mean = sum / static_cast<double>(lost.size());
  // 20 km have 10 000 independent values: 1 % of a standard deviation, four times
  EXPECT_NEAR(mean, 0.3, 0.04 * 0.02);
  const double variance = mean_product(lost, mean, 0);
  EXPECT_NEAR(std::sqrt(variance), 0.02, 0.04 * 0.02);
  EXPECT_NEAR(mean_product(lost, mean, kPerMetre) / variance, std::exp(-1.0), 0.04);
}

TEST(WheelSlip, GrowsOnSoftGround) {
  VehicleModelParams params;
  params.slip_sd = 0.0;
  const WheelSlip slip(params, 1);
  EXPECT_DOUBLE_EQ(slip.slip_ratio(0.0), 0.03);
  EXPECT_GT(slip.slip_ratio(0.5), slip.slip_ratio(0.1));
  EXPECT_GT(std::abs(slip.side_slip_rad(1.0)), std::abs(slip.side_slip_rad(0.0)));
  EXPECT_LE(slip.slip_ratio(5.0), 0.9);
}

TEST(WheelSlip, IsZeroWithZeroParameters) {
  VehicleModelParams params;
  params.slip_share = params.slip_sd = params.side_slip_sd_rad = 0.0;
  WheelSlip slip(params, 1);
  slip.advance(1.0);
  EXPECT_EQ(slip.slip_ratio(0.0), 0.0);
  EXPECT_EQ(slip.side_slip_rad(0.0), 0.0);
}

}  // namespace
}  // namespace adit
