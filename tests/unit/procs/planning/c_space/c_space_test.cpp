// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/c_space.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"
#include "common/types/body_outline.hpp"
#include "procs/planning/c_space/footprint.hpp"
#include "tests/support/robots/chamfered_vehicle.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kCellM = 0.1;
constexpr double kHigh = 1.0;             // too high for the belly
constexpr double kStepM = 0.22;           // too high for a wheel, low enough for the belly
const Pose2 kFarAway{100.0, 100.0, 0.0};  // a robot that is not on the map

/// Kernels and C-space of a terrain map without a robot on it.
struct Mapped {
  explicit Mapped(const TerrainMap& terrain_map, const CSpaceParams& params = {},
                  const Vehicle& of_vehicle = {})
      : terrain(terrain_map),
        vehicle(of_vehicle),
        layers(ground_layers(terrain, kFarAway, vehicle, params.ground)),
        kernels(vehicle, params, terrain.cell_m),
        space(kernels.convolve(layers)) {}

  /// The cost at the cell and heading nearest to a pose.
  [[nodiscard]] std::uint16_t at(const Pose2& T_level_body) const {
    const Eigen::Vector2d cell =
        (T_level_body.translation() - terrain.p_level_corner) / terrain.cell_m;
    return space.slice(kernels.headings().nearest(T_level_body.theta))[space.index(
        static_cast<int>(std::floor(cell.x())), static_cast<int>(std::floor(cell.y())))];
  }

  TerrainMap terrain;
  Vehicle vehicle;
  GroundLayers layers;
  CSpaceKernels kernels;
  CSpace space;
};

TerrainMap random_ground(std::uint32_t seed, double side_m) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  TerrainMap terrain = even_ground(side_m, kCellM);
  for (TerrainCell& cell : terrain.cells) {
    const double kind = share(engine);
    cell = obstacle_cell(0.17 * share(engine));
    if (kind < 0.1) cell = unmeasured_cell(Ground::kOccluded);
    if (kind < 0.004) cell = obstacle_cell(kStepM);
    if (kind < 0.002) cell = obstacle_cell(kHigh);
  }
  return terrain;
}

/// The sum of a layer over a kernel, cell by cell; cells outside the layer count `outside`.
std::uint32_t direct_sum(const CellLayer& layer, const RunKernel& kernel, int column, int row,
                         std::uint32_t outside) {
  std::uint32_t sum = 0;
  for (const auto& run : kernel.runs) {
    for (int dx = run.first; dx <= run.last; ++dx) {
      const int x = column + dx;
      const int y = row + run.row;
      sum += layer.contains({x, y}) ? layer.at({x, y}) : outside;
    }
  }
  return sum;
}

TEST(CSpace, IsTheDirectSumOverTheKernelAtEachPose) {
  const Mapped mapped(random_ground(1, 8.0));
  const auto outside =
      static_cast<std::uint32_t>(std::lround(255 * GroundLimits{}.unknown_roughness));
  int free = 0;
  for (int k = 0; k < mapped.space.headings(); ++k) {
    const auto& kernel = mapped.kernels.oriented(k);
    for (int row = 0; row < mapped.space.rows(); ++row) {
      for (int column = 0; column < mapped.space.columns(); ++column) {
        const auto sum = [&](const CellLayer& layer, const RunKernel& of, std::uint32_t beyond) {
          return direct_sum(layer, of, column, row, beyond);
        };
        const bool lethal = sum(mapped.layers.under_body, kernel.lethal_body, 0) +
                                sum(mapped.layers.under_wheels, kernel.lethal_wheels, 0) >
                            0;
        const bool marginal = sum(mapped.layers.under_body, kernel.conservative_body, 0) +
                                  sum(mapped.layers.unknown, kernel.conservative_body, 0) +
                                  sum(mapped.layers.under_wheels, kernel.conservative_wheels, 0) >
                              0;
        const std::uint16_t expected =
            lethal ? CSpace::kLethal
                   : kernel.cost(sum(mapped.layers.roughness, kernel.wheels, outside),
                                 sum(mapped.layers.roughness, kernel.body, outside),
                                 sum(mapped.layers.unknown, kernel.wheels, 1));
        const std::uint16_t cost = mapped.space.slice(k)[mapped.space.index(column, row)];
        ASSERT_EQ(CSpace::unmarked(cost), expected);
        ASSERT_EQ(CSpace::is_marginal(cost), marginal && expected < CSpace::kUnknown);
        if (expected < CSpace::kUnknown) ++free;
      }
    }
  }
  EXPECT_GT(free, 1000);  // the comparison covers poses that are not lethal
}

TEST(CSpace, IsMarginalOrLethalWhereAnyContinuousPoseIsLethal) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  std::uniform_real_distribution<double> angle(-4.0, 4.0);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int covered = 0;
  for (int round = 0; round < 60; ++round) {
    const bool high = round % 2 == 0;
    TerrainMap terrain = even_ground(10.0, kCellM);
    const int column = 45 + round % 10;
    const int row = 43 + round % 13;
    terrain.cells.at({column, row}) = obstacle_cell(high ? kHigh : kStepM);
    const Mapped mapped(terrain, {}, round % 3 == 0 ? chamfered({}, 0.4) : Vehicle{});
    const std::vector<ConvexPolygon> body{body_outline(mapped.vehicle)};
    const auto polygons = high ? body : wheel_tracks(mapped.vehicle);
    for (int i = 0; i < 3000; ++i) {
      // The obstacle may be at any point of its cell.
      const Eigen::Vector2d p =
          terrain.p_level_corner +
          kCellM * Eigen::Vector2d(column + share(engine), row + share(engine));
      const Pose2 pose{place(engine), place(engine), angle(engine)};
      if (!any_contains(polygons, pose.inverse() * p)) continue;
      ++covered;
      const std::uint16_t cost = mapped.at(pose);
      ASSERT_TRUE(cost == CSpace::kLethal || CSpace::is_marginal(cost))
          << pose.x << ' ' << pose.y << ' ' << pose.theta;
    }
  }
  EXPECT_GT(covered, 10000);
}

TEST(CSpace, ConservativeKernelsExceedTheFootprintByTheCellAndHeadingOnly) {
  // Half a cell for the pose and half for the point in x and in y, half a heading at the corner,
  // and the margin of 1 cm of the kernels.
  const Mapped even(even_ground(10.0));
  for (int k = 0; k < even.kernels.headings().count(); ++k) {
    const double half_gap = 0.12;  // 0.098 for 32 headings; their spacing is uneven
    const double corner = std::hypot(1.2, 0.6);
    const double margin = kCellM * std::sqrt(2.0) + corner * half_gap + 0.02;
    const ConvexPolygon grown = body_outline(even.vehicle).grown(margin);
    const Pose2 turned{0.0, 0.0, even.kernels.headings().angle(k)};
    for (const auto& run : even.kernels.oriented(k).conservative_body.runs) {
      for (int dx = run.first; dx <= run.last; ++dx) {
        const Eigen::Vector2d p = kCellM * Eigen::Vector2d(dx, run.row);
        EXPECT_TRUE(grown.contains(turned.inverse() * p)) << k;
      }
    }
  }
}

/// Beside the cut corner stands what a rectangle of the same size would hit.
TEST(CSpace, IsFreeBesideACutCorner) {
  TerrainMap terrain = even_ground(10.0);
  paint_box(terrain, obstacle_cell(kHigh), {1.05, 0.45}, {1.15, 0.55});
  EXPECT_EQ(Mapped(terrain).at({0.02, 0.02, 0.0}), CSpace::kLethal);
  const Mapped cut(terrain, {}, chamfered({}, 0.55));
  const Pose2 pose{0.05, 0.05, 0.0};  // the middle of a cell
  EXPECT_NE(cut.at(pose), CSpace::kLethal);
  const Eigen::Vector2i at = terrain.cell_at(pose.translation());
  const RunKernel& body = cut.kernels.oriented(cut.kernels.headings().nearest(0.0)).exact_body;
  EXPECT_EQ(direct_sum(cut.layers.under_body, body, at.x(), at.y(), 0), 0U);
}

TEST(CSpace, IsLethalAtAnObstacleBetweenTheWheels) {
  TerrainMap terrain = even_ground(10.0);
  paint_box(terrain, obstacle_cell(0.5), {-0.05, -0.05}, {0.05, 0.05});
  EXPECT_EQ(Mapped(terrain).at({0.0, 0.0, 0.0}), CSpace::kLethal);
}

TEST(CSpace, AllowsToStraddleAStepThatBlocksTheWheels) {
  TerrainMap terrain = even_ground(10.0);
  paint_box(terrain, obstacle_cell(kStepM), {-5.0, 0.0}, {5.0, 0.1});
  const Mapped mapped(terrain);
  EXPECT_LT(mapped.at({0.0, 0.05, 0.0}), CSpace::kUnknown);
  EXPECT_EQ(mapped.at({0.0, 0.55, 0.0}), CSpace::kLethal);  // a wheel on it
}

TEST(CSpace, CostsMoreWithARailUnderTheWheelsThanBetweenThem) {
  TerrainMap terrain = even_ground(10.0);
  paint_box(terrain, obstacle_cell(0.1), {-5.0, 0.0}, {5.0, 0.1});
  const Mapped mapped(terrain);
  const int between = mapped.at({0.0, 0.05, 0.0}) - CSpace::kEven;
  const int under = mapped.at({0.0, 0.55, 0.0}) - CSpace::kEven;
  EXPECT_GT(between, 0);
  EXPECT_GT(under, 5 * between);
  EXPECT_EQ(mapped.at({0.0, 2.0, 0.0}), CSpace::kEven);
}

TEST(CSpace, IsLethalAtALowRoofWaterADropAndASlope) {
  TerrainCell slope = obstacle_cell(0.1);
  slope.slope_rad = 0.5F;
  for (const TerrainCell& cell : {roofed_cell(1.05), unmeasured_cell(Ground::kNoReturn),
                                  unmeasured_cell(Ground::kBelowRay), slope}) {
    TerrainMap terrain = even_ground(10.0);
    paint_box(terrain, cell, {-0.3, 0.3}, {0.3, 0.7});
    EXPECT_EQ(Mapped(terrain).at({0.0, 0.0, 0.0}), CSpace::kLethal);
    EXPECT_EQ(Mapped(terrain).at({0.0, -2.0, 0.0}), CSpace::kEven);
  }
}

/// Behind the lip of a low roof the floor is seen, and not what is above it.
TEST(CSpace, DoesNotTakeTheBodyWhereTheHeadroomIsHidden) {
  const float hidden_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(lethal_reason(roofed_cell(hidden_m), Vehicle{}, {}), BlockingCell::Reason::kUnknown);
  TerrainMap terrain = even_ground(8.0, kCellM);
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    terrain.cells.at({terrain.cells.columns() / 2, row}) = roofed_cell(hidden_m);
  }
  const double middle_m = terrain.centre(terrain.cells.columns() / 2, 0).x();
  const Mapped mapped(terrain);
  EXPECT_EQ(mapped.at({middle_m, 0.0, 0.0}), CSpace::kLethal);
  EXPECT_LT(mapped.at({middle_m - 2.0, 0.0, 0.0}), CSpace::kUnknown);
}

TEST(CSpace, ToleratesALimitedShareOfUnobservedGroundUnderTheWheels) {
  TerrainMap little = even_ground(10.0);
  paint_box(little, unmeasured_cell(Ground::kNeverObserved), {0.0, -1.0}, {0.25, 1.0});
  EXPECT_LT(Mapped(little).at({0.0, 0.0, 0.0}), CSpace::kUnknown);
  TerrainMap much = even_ground(10.0);
  paint_box(much, unmeasured_cell(Ground::kNeverObserved), {0.0, -1.0}, {1.5, 1.0});
  EXPECT_EQ(Mapped(much).at({0.0, 0.0, 0.0}), CSpace::kUnknown);
}

TEST(CSpace, AllowsAGapOf1Point8MetresAtEachHeading) {
  const HeadingSet headings(CSpaceParams{}.headings);
  for (int k = 0; k < headings.count(); ++k) {
    TerrainMap terrain = even_ground(10.0);
    const Pose2 turned{0.05, 0.05, headings.angle(k)};
    paint(terrain, obstacle_cell(kHigh),
          [&](const Eigen::Vector2d& p) { return std::abs((turned.inverse() * p).y()) > 0.9; });
    EXPECT_LT(Mapped(terrain).at(turned), CSpace::kUnknown) << k;
  }
}

TEST(CSpace, RejectsCellsTooSmallOrTooLargeForTheVehicle) {
  EXPECT_THROW(CSpaceKernels(Vehicle{}, CSpaceParams{}, 0.02), std::invalid_argument);
  EXPECT_THROW(CSpaceKernels(Vehicle{}, CSpaceParams{}, 5.0), std::invalid_argument);
}

}  // namespace
}  // namespace adit
