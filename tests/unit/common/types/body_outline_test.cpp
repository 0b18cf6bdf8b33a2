// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/types/body_outline.hpp"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/robots/chamfered_vehicle.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

std::string rejection_of(const Vehicle& vehicle) {
  try {
    body_outline(vehicle);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(BodyOutline, IsTheRectangleUnlessAFootprintIsGiven) {
  const ConvexPolygon outline = body_outline({});
  EXPECT_EQ(outline.corners().size(), 4U);
  EXPECT_DOUBLE_EQ(outline.area_m2(), 2.4 * 1.2);
  const ConvexPolygon octagon = body_outline(chamfered({}, 0.3));
  EXPECT_EQ(octagon.corners().size(), 8U);
  EXPECT_NEAR(octagon.area_m2(), 2.4 * 1.2 - 4.0 * 0.5 * 0.3 * 0.3, 1e-12);
}

TEST(BodyOutline, GrowsByAMarginOnAllSides) {
  for (const double by_m : {0.1, -0.1}) {
    for (const Vehicle& vehicle : {Vehicle{}, chamfered({}, 0.3)}) {
      const Vehicle grown = with_outline_grown(vehicle, by_m);
      EXPECT_NEAR(grown.length_m, 2.4 + 2.0 * by_m, 1e-12);
      EXPECT_NEAR(grown.width_m, 1.2 + 2.0 * by_m, 1e-12);
      EXPECT_EQ(grown.track_m, vehicle.track_m);
      EXPECT_EQ(grown.footprint.size(), vehicle.footprint.size());
      EXPECT_NEAR(body_outline(grown).area_m2(), body_outline(vehicle).grown(by_m).area_m2(), 1e-9);
    }
  }
}

TEST(BodyOutline, SaysWhatIsWrongWithAFootprint) {
  Vehicle vehicle = chamfered({}, 0.3);
  vehicle.footprint[0].y_m -= 0.05;
  EXPECT_THAT(rejection_of(vehicle), HasSubstr("symmetric"));
  vehicle = chamfered({}, 0.3);
  vehicle.length_m = 2.0;
  EXPECT_THAT(rejection_of(vehicle), HasSubstr("is 2.400 m long and 1.200 m wide"));
  vehicle.footprint = {{1.0, 0.0}, {-1.0, 0.0}};
  EXPECT_THAT(rejection_of(vehicle), HasSubstr("fewer than 3"));
}

}  // namespace
}  // namespace adit
