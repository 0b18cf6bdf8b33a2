// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/drive/key_driver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(KeyReader, DecodesLettersAndArrows) {
  KeyReader reader;
  EXPECT_THAT(reader.read("wasd q"),
              ElementsAre(DriveKey::kFaster, DriveKey::kLeft, DriveKey::kSlower, DriveKey::kRight,
                          DriveKey::kStop, DriveKey::kQuit));
  EXPECT_THAT(reader.read("\x1b[A\x1b[B\x1bOC\x1b[D"),
              ElementsAre(DriveKey::kFaster, DriveKey::kSlower, DriveKey::kRight, DriveKey::kLeft));
}

TEST(KeyReader, WaitsForTheRestOfAnArrow) {
  KeyReader reader;
  EXPECT_THAT(reader.read("\x1b"), IsEmpty());
  EXPECT_THAT(reader.read("["), IsEmpty());
  EXPECT_THAT(reader.read("A"), ElementsAre(DriveKey::kFaster));
}

TEST(KeyReader, IgnoresOtherKeys) {
  KeyReader reader;
  EXPECT_THAT(reader.read("xyzAB\n\x1b[Z\x1bw"), ElementsAre(DriveKey::kFaster));
}

TEST(KeyDriver, StandsInitiallyAndAfterSpace) {
  KeyDriver driver(Vehicle{});
  EXPECT_EQ(driver.command(7), (DriveCommand{7, 0.0, 0.0}));
  for (const DriveKey key : {DriveKey::kFaster, DriveKey::kLeft, DriveKey::kStop}) {
    driver.press(key);
  }
  EXPECT_EQ(driver.command(8), (DriveCommand{8, 0.0, 0.0}));
}

TEST(KeyDriver, KeepsTheLimitsOfTheVehicle) {
  const Vehicle vehicle;
  KeyDriver driver(vehicle);
  for (int i = 0; i < 20; ++i) {
    driver.press(DriveKey::kSlower);
    driver.press(DriveKey::kRight);
  }
  const DriveCommand command = driver.command(0);
  EXPECT_NEAR(command.speed_m_s, -vehicle.speed_max_m_s, 1e-12);  // rounding
  EXPECT_NEAR(command.curvature_1_m, -1.0 / vehicle.turning_radius_m, 1e-12);
}

TEST(KeyDriver, QuitsOnQ) {
  KeyDriver driver(Vehicle{});
  EXPECT_FALSE(driver.quits());
  driver.press(DriveKey::kQuit);
  EXPECT_TRUE(driver.quits());
}

}  // namespace
}  // namespace adit
