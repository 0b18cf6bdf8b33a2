// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/wall_agreement.hpp"

#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

class RoomAgreement : public testing::Test {
 protected:
  RoomAgreement() { reference_.insert(walls_.points, {}, 0.0); }

  [[nodiscard]] WallAgreement at(const Pose2& T_reference_points) const {
    return agreement(walls_.points, T_reference_points, reference_, walls_.views, {});
  }

  LocalWalls walls_ = test::walls_of(test::crooked_room(), {-3.0, 0.0, 0.0}, 3.0);
  SurfelMap reference_{SurfelMapParams{}};
};

TEST_F(RoomAgreement, OfAMapWithItselfIsWhole) {
  const WallAgreement found = at({});
  EXPECT_EQ(found.near, found.points);
  EXPECT_EQ(found.contradicting, 0);
  EXPECT_GT(found.log_likelihood, 2.0 * found.points);
}

TEST_F(RoomAgreement, IsContradictedByWallsInFreeSpace) {
  const WallAgreement found = at({0.0, 0.0, 1.0});
  EXPECT_GT(found.contradicting, found.points / 6);
  EXPECT_LT(found.log_likelihood, 0.0);
}

TEST_F(RoomAgreement, FallsWithTheDistanceFromTheTruth) {
  double last = at({}).log_likelihood;
  for (const double off : {0.05, 0.1, 0.2, 0.4}) {
    const double here = at({off, off, 0.0}).log_likelihood;
    EXPECT_LT(here, last) << off;
    last = here;
  }
}

TEST_F(RoomAgreement, SaysNothingOfWhatWasNeverSeen) {
  const WallAgreement found = at({200.0, 0.0, 0.0});
  EXPECT_EQ(found.known(), 0);
  EXPECT_EQ(found.log_likelihood, 0.0);
}

}  // namespace
}  // namespace adit
