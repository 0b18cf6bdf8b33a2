// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/cloud_pieces.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "common/messages/planar.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;

constexpr float kNotFinite = std::numeric_limits<float>::quiet_NaN();

/// Of lines of 361 beams, each tenth of which met nothing.
Cloud cloud(int lines, std::int32_t id = 7) {
  Cloud result{kUtime, id, {12.0, -3.0, 0.7}, false, {}};
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

/// Their bits, which is more than equality.
std::vector<std::vector<std::uint8_t>> bytes_of(const Cloud& cloud) {
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const CloudPiece& piece : divide(cloud)) bytes.push_back(encode(to_message(piece)));
  return bytes;
}

std::string_view refusal_after(const std::function<void(cloud_t&)>& change) {
  cloud_t message = to_message(divide(cloud(2)).front());
  change(message);
  return from_message(message).refusal();
}

TEST(CloudPieces, OfAWholeSweepAreAllSmall) {
  const auto pieces = bytes_of(cloud(240));
  EXPECT_LT(pieces.size(), 20U);
  for (const auto& bytes : pieces) EXPECT_LE(bytes.size(), kPieceBytes);
}

TEST(CloudPieces, GoOverTheWireAndAreJoinedInAnyOrder) {
  const Cloud sent = cloud(240);
  auto messages = bytes_of(sent);
  std::rotate(messages.begin(), messages.begin() + 5, messages.end());
  std::swap(messages.front(), messages.back());
  CloudAssembler assembler;
  std::optional<Cloud> received;
  for (const auto& bytes : messages) {
    EXPECT_FALSE(received);
    received = assembler.add(*from_message(*decode<cloud_t>(bytes)));
  }
  ASSERT_TRUE(received);
  EXPECT_EQ(bytes_of(*received), bytes_of(sent));
}

TEST(CloudPieces, OfACloudWithoutLinesIsOne) {
  const auto pieces = divide(cloud(0));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(CloudAssembler().add(*test::over_the_wire(pieces[0]))->lines.empty());
}

TEST(CloudPieces, GiveALineThatIsTooLargeAPieceOfItsOwn) {
  Cloud sent = cloud(3);
  sent.lines[1].points.resize(10'000, Eigen::Vector3f::Ones());
  const auto pieces = divide(sent);
  EXPECT_EQ(pieces.size(), 3U);
  for (const CloudPiece& piece : pieces) EXPECT_TRUE(test::over_the_wire(piece));
}

TEST(CloudMessage, IsRefusedWithAHeadThatCannotBe) {
  using Message = cloud_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](Message& m) { m.id = -1; }), "negative id");
  EXPECT_EQ(refusal_after([](Message& m) { m.T_odom_level[2] = kNaN; }), kPoseNotFinite);
  EXPECT_EQ(refusal_after([](Message& m) { m.n_pieces = 0; }), "no pieces");
  EXPECT_EQ(refusal_after([](Message& m) { m.n_pieces = INT32_MAX; }),
            "more pieces than plausible");
  EXPECT_EQ(refusal_after([](Message& m) { m.piece = 1; }), "piece of a higher number");
}

TEST(CloudMessage, IsRefusedWithLinesThatCannotBe) {
  using Message = cloud_t;
  EXPECT_EQ(refusal_after([](Message& m) { m.lines[1].utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](Message& m) { m.lines[1].utime = m.utime + 1; }),
            "line after the end of the sweep");
  EXPECT_EQ(refusal_after([](Message& m) { m.lines[1].origin[0] = kNotFinite; }),
            "origin that cannot be");
  EXPECT_EQ(refusal_after([](Message& m) { m.lines[1].points[5][2] = kNotFinite; }),
            "point that cannot be");
  EXPECT_EQ(refusal_after([](Message& m) { m.lines[1].points[5][2] = 1e30F; }),
            "point that cannot be");
  for (const float x : {0.0F, 2.0F, kNotFinite}) {
    EXPECT_EQ(refusal_after([x](Message& m) {
                m.lines[0].misses[3] = {x, 0.0F, 0.0F};
              }),
              "miss without a direction");
  }
}

TEST(CloudAssembler, DropsWhatIsIncompleteForANewerCloud) {
  const auto older = divide(cloud(40, 7));
  const auto newer = divide(cloud(40, 8));
  CloudAssembler assembler;
  assembler.add(older[0]);
  assembler.add(newer[0]);
  EXPECT_FALSE(assembler.add(older[1]));
  std::optional<Cloud> last;
  for (std::size_t i = 1; i < newer.size(); ++i) last = assembler.add(newer[i]);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->id, 8);
  EXPECT_EQ(assembler.counts(), (CloudAssembler::Counts{1, 0, 0, 1, 1, 0}));
}

TEST(CloudAssembler, CountsPiecesThatComeTwiceOrDoNotBelong) {
  const auto pieces = divide(cloud(40));
  CloudAssembler assembler;
  assembler.add(pieces[0]);
  EXPECT_FALSE(assembler.add(pieces[0]));
  CloudPiece other = pieces[1];
  other.part.T_odom_level.x += 1.0;
  EXPECT_FALSE(assembler.add(other));
  EXPECT_EQ(assembler.counts().duplicates, 1);
  EXPECT_EQ(assembler.counts().contradictory, 1);
}

TEST(CloudAssembler, HoldsNoMoreBytesThanItMay) {
  CloudAssembler assembler(1000);
  EXPECT_FALSE(assembler.add(divide(cloud(40))[0]));
  EXPECT_EQ(assembler.counts().given_up, 1);
}

}  // namespace
}  // namespace adit
