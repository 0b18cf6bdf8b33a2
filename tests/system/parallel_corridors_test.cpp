// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Figure 4 of the paper: the robot takes one of two parallel corridors for the other, and finds out
// at the corner.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/parallel_drive.hpp"

namespace adit {
namespace {

class ParallelCorridors : public testing::TestWithParam<double> {};

int closures_in_force(const Mapping& mapping) {
  const auto& chosen = mapping.association().belief().chosen;
  return static_cast<int>(
      std::ranges::count_if(chosen, [](int c) { return c != Association::kNone; }));
}

TEST_P(ParallelCorridors, AreToldApartAtTheCorner) {
  test::ParallelDrive drive(GetParam());
  double error_before_m = 0.0;
  int closures_before = 0;
  auto update = drive.next();
  for (; update && test::revoked(*update) == 0; update = drive.next()) {
    error_before_m = drive.newest_error_m();
    closures_before = closures_in_force(drive.mapping());
  }
  ASSERT_TRUE(update) << "nothing was ever revoked";
  EXPECT_GT(error_before_m, 5.0);  // in the wrong corridor, 12 m from the right one
  EXPECT_GT(closures_before, 5);
  EXPECT_EQ(test::revoked(*update), closures_before);
  EXPECT_GT(test::chosen_anew(*update), 5);
  EXPECT_LT(drive.newest_error_m(), 0.5);

  while (drive.next()) {
  }
  EXPECT_LE(drive.error().rmse_m, 0.2);  // on 920 m, of which 800 m are held at their ends alone
}

INSTANTIATE_TEST_SUITE_P(YawBias, ParallelCorridors, testing::Values(-0.022, -0.026),
                         [](const auto& instance) {
                           return std::to_string(std::lround(-1e6 * instance.param)) +
                                  "MicrodegreesPerMetre";
                         });

TEST(ParallelCorridorsWithoutBias, NothingIsRevoked) {
  test::ParallelDrive drive(0.0);
  int revoked = 0;
  while (const auto update = drive.next()) revoked += test::revoked(*update);
  EXPECT_EQ(revoked, 0);
  EXPECT_GT(closures_in_force(drive.mapping()), 5);
  EXPECT_LE(drive.error().rmse_m, 0.2);
}

}  // namespace
}  // namespace adit
