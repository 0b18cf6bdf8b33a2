// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/cloud.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/planar_geometry.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;

constexpr float kNotFinite = std::numeric_limits<float>::quiet_NaN();

/// A cloud with lines of 361 beams, every tenth without a return.
Cloud cloud(int lines, std::int32_t id = 7) {
  Cloud result{kUtime, id, {12.0, -3.0, 0.7}, false, {}, -1.25};
  for (int i = 0; i < lines; ++i) {
    CloudLine line{
        kUtime - 1000 * (lines - i), {1.0F, 0.001F * static_cast<float>(i), 0.6F}, {}, {}};
    for (int beam = 0; beam < 361; ++beam) {
      const float bearing = 0.0087F * static_cast<float>(beam - 180);
      const Eigen::Vector3f direction(std::cos(bearing), std::sin(bearing), 0.0F);
      if (beam % 10 == 0) {
        line.misses.push_back(direction);
      } else {
        line.points.push_back(7.3F * direction);
      }
    }
    result.lines.push_back(line);
  }
  return result;
}

/// The encoded fragments, which compare all bits.
std::vector<std::vector<std::uint8_t>> bytes_of(const Cloud& cloud) {
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const CloudFragment& fragment : split(cloud)) bytes.push_back(encode(to_message(fragment)));
  return bytes;
}

std::string_view rejection_after(const std::function<void(cloud_t&)>& change) {
  cloud_t message = to_message(split(cloud(2)).front());
  change(message);
  return from_message(message).rejection();
}

TEST(CloudFragments, FitTheSizeLimit) {
  const auto fragments = bytes_of(cloud(240));
  EXPECT_LT(fragments.size(), 20U);
  for (const auto& bytes : fragments) EXPECT_LE(bytes.size(), kFragmentBytes);
}

TEST(CloudFragments, AreReassembledInAnyOrder) {
  const Cloud sent = cloud(240);
  auto messages = bytes_of(sent);
  std::rotate(messages.begin(), messages.begin() + 5, messages.end());
  std::swap(messages.front(), messages.back());
  CloudReassembler reassembler;
  std::optional<Cloud> received;
  for (const auto& bytes : messages) {
    EXPECT_FALSE(received);
    received = reassembler.add(*from_message(*decode<cloud_t>(bytes)));
  }
  ASSERT_TRUE(received);
  EXPECT_EQ(bytes_of(*received), bytes_of(sent));
}

TEST(CloudFragments, AreOneForACloudWithoutLines) {
  const auto fragments = split(cloud(0));
  ASSERT_EQ(fragments.size(), 1U);
  EXPECT_TRUE(CloudReassembler().add(*test::round_trip(fragments[0]))->lines.empty());
}

TEST(CloudFragments, GiveAnOversizedLineItsOwnFragment) {
  Cloud sent = cloud(3);
  sent.lines[1].points.resize(10'000, Eigen::Vector3f::Ones());
  const auto fragments = split(sent);
  EXPECT_EQ(fragments.size(), 3U);
  for (const CloudFragment& fragment : fragments) EXPECT_TRUE(test::round_trip(fragment));
}

TEST(CloudMessage, IsRejectedWithAnInvalidHeader) {
  using Message = cloud_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.id = -1; }), "negative id");
  EXPECT_EQ(rejection_after([](Message& m) { m.T_odom_level[2] = kNaN; }), kImplausibleHeading);
  EXPECT_EQ(rejection_after([](Message& m) { m.z_odom_m = kNaN; }), kImplausibleHeight);
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = 0; }), "no fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.n_fragments = INT32_MAX; }),
            "implausible number of fragments");
  EXPECT_EQ(rejection_after([](Message& m) { m.fragment = 1; }), "fragment index out of range");
}

TEST(CloudMessage, IsRejectedWithInvalidLines) {
  using Message = cloud_t;
  EXPECT_EQ(rejection_after([](Message& m) { m.lines[1].utime = -1; }), kImplausibleTime);
  EXPECT_EQ(rejection_after([](Message& m) { m.lines[1].utime = m.utime + 1; }),
            "line after the end of the sweep");
  EXPECT_EQ(rejection_after([](Message& m) { m.lines[1].origin[0] = kNotFinite; }),
            "implausible origin");
  EXPECT_EQ(rejection_after([](Message& m) { m.lines[1].points[5][2] = kNotFinite; }),
            "implausible point");
  EXPECT_EQ(rejection_after([](Message& m) { m.lines[1].points[5][2] = 1e30F; }),
            "implausible point");
  for (const float x : {0.0F, 2.0F, kNotFinite}) {
    EXPECT_EQ(rejection_after([x](Message& m) {
                m.lines[0].misses[3] = {x, 0.0F, 0.0F};
              }),
              "miss direction is not a unit vector");
  }
}

TEST(CloudReassembler, ReplacesAnIncompleteCloudByANewerOne) {
  const auto older = split(cloud(40, 7));
  const auto newer = split(cloud(40, 8));
  CloudReassembler reassembler;
  reassembler.add(older[0]);
  reassembler.add(newer[0]);
  EXPECT_FALSE(reassembler.add(older[1]));
  std::optional<Cloud> last;
  for (std::size_t i = 1; i < newer.size(); ++i) last = reassembler.add(newer[i]);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->id, 8);
  EXPECT_EQ(reassembler.counts(), (CloudReassembler::Counts{1, 0, 0, 1, 1, 0}));
}

TEST(CloudReassembler, CountsDuplicateAndContradictoryFragments) {
  const auto fragments = split(cloud(40));
  CloudReassembler reassembler;
  reassembler.add(fragments[0]);
  EXPECT_FALSE(reassembler.add(fragments[0]));
  CloudFragment other = fragments[1];
  other.part.T_odom_level.x += 1.0;
  EXPECT_FALSE(reassembler.add(other));
  EXPECT_EQ(reassembler.counts().duplicates, 1);
  EXPECT_EQ(reassembler.counts().contradictory, 1);
}

TEST(CloudReassembler, RespectsTheByteLimit) {
  CloudReassembler reassembler({.incomplete = 1, .bytes = 1000});
  EXPECT_FALSE(reassembler.add(split(cloud(40))[0]));
  EXPECT_EQ(reassembler.counts().abandoned, 1);
}

}  // namespace
}  // namespace adit
