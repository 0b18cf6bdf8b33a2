// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Decoding of malformed or hostile messages.
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "adit/heartbeat_t.hpp"
#include "adit/planar_lidar_t.hpp"
#include "adit/pose_t.hpp"
#include "traps/nested_t.hpp"

#include "common/messages/codec.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;

void write_int32(Bytes& bytes, std::size_t at, std::int32_t value) {
  for (int i = 0; i < 4; ++i) {
    bytes.at(at + i) = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
  }
}

Bytes scan_bytes() {
  planar_lidar_t scan;
  scan.utime = 17;
  scan.nranges = 3;
  scan.ranges = {1.0F, 2.0F, 3.0F};
  scan.nintensities = 0;
  scan.rad0 = -1.0F;
  scan.radstep = 0.1F;
  return encode(scan);
}
constexpr std::size_t kCountOfRanges = 16;  // after the fingerprint and the time

Bytes heartbeat_bytes() {
  heartbeat_t heartbeat{};
  heartbeat.stage = "mapping";
  return encode(heartbeat);
}
constexpr std::size_t kLengthOfStage = 16;

traps::nested_t nested() {
  traps::nested_t message;
  message.utime = 17;
  message.rows = 2;
  message.columns = 2;
  message.grid = {{1.0F, 2.0F}, {3.0F, 4.0F}};
  message.fixed_inner = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  message.names = {"front", "rear"};
  message.raw = {7, 8};
  message.leaves.resize(2);
  for (traps::leaf_t& leaf : message.leaves) {
    leaf.n = 1;
    leaf.values = {9};
  }
  message.title = "all shapes";
  return message;
}

constexpr std::int32_t kBadCounts[] = {-1,
                                       std::numeric_limits<std::int32_t>::min(),
                                       std::numeric_limits<std::int32_t>::max(),
                                       1'000'000'000,
                                       1000,
                                       1 << 30};

TEST(Decode, RestoresAnEncodedMessage) {
  const auto decoded = decode<planar_lidar_t>(scan_bytes());
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->utime, 17);
  EXPECT_EQ(decoded->ranges, (std::vector{1.0F, 2.0F, 3.0F}));
}

TEST(Decode, RestoresEveryShapeOfArray) {
  const Bytes bytes = encode(nested());
  const auto decoded = decode<traps::nested_t>(bytes);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(encode(*decoded), bytes);
}

TEST(Decode, RejectsEveryTruncation) {
  const Bytes bytes = encode(nested());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode<traps::nested_t>(std::span(bytes).first(size))) << size;
  }
}

TEST(Decode, RejectsAnEmptyMessage) {
  EXPECT_EQ(decode<pose_t>({}).rejection(), "shorter than a fingerprint");
}

TEST(Decode, RejectsAnotherTypesFingerprint) {
  EXPECT_EQ(decode<pose_t>(scan_bytes()).rejection(), "fingerprint of another type");
}

TEST(Decode, RejectsTrailingBytes) {
  Bytes bytes = scan_bytes();
  bytes.push_back(0);
  EXPECT_EQ(decode<planar_lidar_t>(bytes).rejection(), "trailing bytes");
}

TEST(Decode, RejectsCountsThatDoNotFit) {
  for (const std::int32_t count : kBadCounts) {
    Bytes bytes = scan_bytes();
    write_int32(bytes, kCountOfRanges, count);
    EXPECT_EQ(decode<planar_lidar_t>(bytes).rejection(), "truncated, or invalid count") << count;
  }
}

TEST(Decode, RejectsLengthsOfStringsThatDoNotFit) {
  for (const std::int32_t length : kBadCounts) {
    Bytes bytes = heartbeat_bytes();
    write_int32(bytes, kLengthOfStage, length);
    EXPECT_FALSE(decode<heartbeat_t>(bytes)) << length;
  }
}

TEST(Decode, RejectsAStringWithoutItsEnd) {
  Bytes bytes = heartbeat_bytes();
  write_int32(bytes, kLengthOfStage, 0);
  EXPECT_FALSE(decode<heartbeat_t>(bytes));
}

TEST(Decode, SurvivesABadCountAnywhereInEveryShapeOfArray) {
  const Bytes good = encode(nested());
  for (std::size_t at = 8; at + 4 <= good.size(); ++at) {
    for (const std::int32_t count : kBadCounts) {
      Bytes bytes = good;
      write_int32(bytes, at, count);
      const auto decoded = decode<traps::nested_t>(bytes);
      if (decoded) {
        EXPECT_EQ(decoded->grid.size(), 2U);
      }
    }
  }
}

}  // namespace
}  // namespace adit
