// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/box_overlap.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// Whether one of many points of the triangle is in the box: never true where the two are apart.
bool has_a_point_inside(const OrientedBox& box, const std::array<Eigen::Vector3d, 3>& triangle) {
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const Eigen::Vector3d p = triangle[0] + (triangle[1] - triangle[0]) * i / kSteps +
                                (triangle[2] - triangle[0]) * j / kSteps;
      const Eigen::Vector3d p_box = box.T_world_box.inverse() * p;
      if ((p_box.cwiseAbs() - box.half_size).maxCoeff() <= 0.0) return true;
    }
  }
  return false;
}

TEST(BoxOverlap, AgreesWithPointsOfTheTriangle) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  const auto point = [&] {
    return Eigen::Vector3d(anywhere(random), anywhere(random), anywhere(random));
  };
  int touching = 0;
  int missed = 0;  // by the points: they leave gaps of a fortieth of an edge
  for (int i = 0; i < 2000; ++i) {
    OrientedBox box;
    box.T_world_box.translation() = 0.5 * point();
    box.T_world_box.linear() =
        Eigen::AngleAxisd(anywhere(random), point().normalized()).toRotationMatrix();
    box.half_size = 0.4 * point().cwiseAbs();
    const std::array<Eigen::Vector3d, 3> triangle{point(), point(), point()};
    const bool inside = has_a_point_inside(box, triangle);
    const bool overlap = overlaps(box, triangle);
    EXPECT_TRUE(overlap || !inside) << i;
    touching += overlap ? 1 : 0;
    missed += overlap && !inside ? 1 : 0;
  }
  EXPECT_GT(touching, 500);
  EXPECT_LT(missed, 0.15 * touching);
}

TEST(BoxOverlap, NothingTouchesACornerThatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OrientedBox box;
  box.half_size = {1.0, 1.0, 1.0};
  EXPECT_FALSE(overlaps(box, {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {nan, 0.0, 0.0}}}));
}

}  // namespace
}  // namespace adit
