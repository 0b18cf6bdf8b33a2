// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/local_map.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "common/messages/planar.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;
using test::over_the_wire;

LocalMapPiece piece() { return {test::local_map(7, 3), 4, 1}; }

std::string_view refusal_after(const std::function<void(local_map_t&)>& change) {
  local_map_t message = to_message(piece());
  change(message);
  return from_message(message).refusal();
}

TEST(LocalMapMessage, GoesThereAndBackBitForBit) { EXPECT_EQ(*over_the_wire(piece()), piece()); }

TEST(LocalMapMessage, MayHaveNoScans) {
  const LocalMapPiece empty{test::local_map(0, 1), 1, 0};
  EXPECT_EQ(*over_the_wire(empty), empty);
}

TEST(LocalMapMessage, KeepsReadingsThatAreNoNumbers) {
  LocalMapPiece strange = piece();
  strange.part.scans[0].scan.ranges_m[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(over_the_wire(strange)->part.scans[0].scan.ranges_m[1]));
}

TEST(LocalMapMessage, HoldsItsInformationRowByRow) {
  EXPECT_EQ(to_message(piece()).information[0][2], 5.0);
  EXPECT_EQ(to_message(piece()).information[1][2], -7.0);
}

TEST(LocalMapMessage, IsRefusedWithATimeThatCannotBe) {
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.utime = -1; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.end_utime = INT64_MAX; }), kImplausibleTime);
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.end_utime = map.utime - 1; }),
            "ends before it begins");
}

TEST(LocalMapMessage, IsRefusedWithNumbersThatMeanNothing) {
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.id = -1; }), "negative id or session");
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.session = -1; }), "negative id or session");
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.T_odom_local[1] = kNaN; }), kPoseNotFinite);
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.T_previous_local[2] = kNaN; }),
            kPoseNotFinite);
}

TEST(LocalMapMessage, IsRefusedWithInformationThatIsNone) {
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.information[2][2] = -1.0; }), kNoInformation);
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.information[0][1] = 25.0; }), kNoInformation);
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.information[1][0] = kNaN; }), kNoInformation);
  EXPECT_EQ(refusal_after([](local_map_t& map) {
              map.information[0][1] = map.information[1][0] = 350.0;  // more than sqrt(400 * 300)
            }),
            kNoInformation);
}

TEST(LocalMapMessage, IsRefusedWithAPlaceAmongItsPiecesThatCannotBe) {
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.n_pieces = 0; }), "no pieces");
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.n_pieces = 1'000'000; }),
            "more pieces than plausible");
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.piece = 4; }), "piece of a higher number");
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.piece = -1; }), "piece of a higher number");
}

TEST(LocalMapMessage, IsRefusedWhereItIsTooLarge) {
  EXPECT_EQ(over_the_wire(LocalMapPiece{test::local_map(7, 1500), 1, 0}).refusal(),
            "larger than a piece may be");
}

TEST(LocalMapMessage, IsRefusedWithScansThatCannotBe) {
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.scans[1].angle_step_rad = 0.0; }),
            "bearings do not increase");
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.scans[1].angle_min_rad = kNaN; }),
            "first bearing is not finite");
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.scans[1].T_local_body[0] = kNaN; }),
            kPoseNotFinite);
  EXPECT_EQ(refusal_after([](local_map_t& map) { map.scans[1].utime = kUtime - 1; }),
            "scan outside of the time of its local map");
}

}  // namespace
}  // namespace adit
