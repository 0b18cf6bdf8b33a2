// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "sim/vehicle/vehicle_model.hpp"
#include "tests/support/box_drift.hpp"

namespace adit {
namespace {

TEST(VehicleModel, DrivesAsTold) {
  const Site site(box_drift());
  VehicleModel vehicle(site, {}, {}, 1, 1'000'000);
  for (int i = 0; i < 1000; ++i) {
    vehicle.command(DriveCommand{vehicle.motion().utime, 0.3, 0.02});
    vehicle.advance(0.01);
  }
  EXPECT_FALSE(vehicle.failure());
  // 10 s at 0.3 m/s, less 0.15 m for acceleration, less 3 % of slip, of which two metres vary
  EXPECT_NEAR(vehicle.travelled_m(), 0.97 * 2.85, 0.1);
}

}  // namespace
}  // namespace adit
