// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "adit/planar_lidar_t.hpp"
#include "adit/pose_t.hpp"
#include "bot_core/planar_lidar_t.hpp"
#include "bot_core/pose_t.hpp"

namespace {

TEST(Fingerprint, OfALaserScanIsThatOfBotCore) {
  EXPECT_EQ(adit::planar_lidar_t::getHash(), bot_core::planar_lidar_t::getHash());
}

TEST(Fingerprint, OfAPoseIsThatOfBotCore) {
  EXPECT_EQ(adit::pose_t::getHash(), bot_core::pose_t::getHash());
}

}  // namespace
