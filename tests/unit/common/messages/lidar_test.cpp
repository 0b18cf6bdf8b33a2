// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/lidar.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/messages/codec.hpp"

namespace adit {
namespace {

constexpr std::int64_t kLidarUtime = 1'600'000'000'000'000;

/// A revolution of 16 rings with ranges of 1 m and more.
LidarRevolution revolution(int columns) {
  LidarRevolution revolution;
  revolution.utime = kLidarUtime;
  for (int i = 0; i < 16; ++i) {
    revolution.rings.push_back(
        {0.03F * static_cast<float>(i - 8), 0.0F, 2.3F * static_cast<float>(i)});
  }
  for (int i = 0; i < columns; ++i) {
    revolution.columns.push_back({55 * i, 3.1F - 0.0035F * static_cast<float>(i)});
    for (int j = 0; j < 16; ++j) {
      revolution.ranges_m.push_back(1.0F + 0.001F * static_cast<float>(i + j));
    }
  }
  return revolution;
}

LidarFragment received(const LidarFragment& fragment) {
  return *from_message(*decode<spinning_lidar_t>(encode(to_message(fragment))));
}

TEST(LidarMessage, FragmentsAreDatagramsAndMakeTheRevolutionAgain) {
  const LidarRevolution sent = revolution(1800);
  const auto fragments = split(sent);
  ASSERT_EQ(fragments.size(), 2U);
  LidarReassembler reassembler;
  std::optional<LidarRevolution> whole;
  for (auto fragment = fragments.rbegin(); fragment != fragments.rend(); ++fragment) {
    EXPECT_LE(encode(to_message(*fragment)).size(), kFragmentBytes);
    whole = reassembler.add(received(*fragment));
  }
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->rings, sent.rings);
  EXPECT_EQ(whole->columns, sent.columns);
  ASSERT_EQ(whole->ranges_m.size(), sent.ranges_m.size());
  for (std::size_t i = 0; i < sent.ranges_m.size(); ++i) {
    ASSERT_NEAR(whole->ranges_m[i], sent.ranges_m[i], 0.5F * kLidarRangeUnitM + 1e-5F);
  }
}

TEST(LidarMessage, KeepsWhatHasNoRange) {
  LidarRevolution sent = revolution(1);
  sent.ranges_m[0] = std::numeric_limits<float>::infinity();
  sent.ranges_m[1] = std::numeric_limits<float>::quiet_NaN();
  sent.ranges_m[2] = 1000.0F;  // farther than can be sent
  sent.ranges_m[3] = 0.0001F;  // nearer
  const LidarRevolution part = received(split(sent).front()).part;
  EXPECT_TRUE(std::isinf(part.ranges_m[0]));
  EXPECT_TRUE(std::isnan(part.ranges_m[1]));
  EXPECT_TRUE(std::isinf(part.ranges_m[2]));
  EXPECT_EQ(part.ranges_m[3], kLidarRangeUnitM);
}

TEST(LidarMessage, IsRejectedIfItsPartsContradictEachOther) {
  const auto rejection = [](auto change) {
    spinning_lidar_t message = to_message(split(revolution(3)).front());
    change(message);
    return from_message(message).rejection();
  };
  EXPECT_EQ(rejection([](auto& m) { m.elevations_rad[1] = m.elevations_rad[0]; }),
            "elevations do not increase");
  EXPECT_EQ(rejection([](auto& m) { m.times_us[2] = m.times_us[1] - 1; }),
            "times of columns do not increase");
  EXPECT_EQ(rejection([](auto& m) { m.fragment = 1; }), "fragment index out of range");
  EXPECT_EQ(rejection([](auto& m) { m.n_fragments = 17; }), "implausible number of fragments");
  EXPECT_EQ(rejection([](auto& m) { m.range_unit_m = 0.0F; }), "implausible unit of the ranges");
  EXPECT_EQ(rejection([](auto& m) {
              m.n_rings = 0;
              m.elevations_rad.clear();
              m.ring_azimuths_rad.clear();
              m.ring_times_us.clear();
              for (auto& ranges : m.ranges) ranges.clear();
            }),
            "implausible number of rings");
}

}  // namespace
}  // namespace adit
