// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include <gtest/gtest.h>

#include "adit/planar_lidar_t.hpp"
#include "adit/pose_t.hpp"
#include "bot_core/planar_lidar_t.hpp"
#include "bot_core/pose_t.hpp"

#include "tests/support/message_types.hpp"

namespace {

TEST(Fingerprint, MatchesBotCoreForALaserScan) {
  EXPECT_EQ(adit::planar_lidar_t::getHash(), bot_core::planar_lidar_t::getHash());
}

TEST(Fingerprint, MatchesBotCoreForAPose) {
  EXPECT_EQ(adit::pose_t::getHash(), bot_core::pose_t::getHash());
}

// The fingerprint covers names, types and order of the members, but not the name of the type: two
// types with equal members would decode as each other.
TEST(Fingerprint, IsUnique) {
  std::map<std::int64_t, std::string> owners;
  for (const adit::MessageType& type : adit::message_types()) {
    const auto [owner, is_new] = owners.emplace(type.fingerprint, type.name);
    EXPECT_TRUE(is_new || owner->second == type.name) << type.name << " and " << owner->second;
  }
}

}  // namespace
