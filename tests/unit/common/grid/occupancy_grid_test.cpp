// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/occupancy_grid.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

OccupancyGridParams ten_centimetres() {
  OccupancyGridParams params;
  params.resolution_m = 0.1;
  return params;
}

LaserScan one_beam(float range_m, double angle_rad) { return {0, {range_m}, angle_rad, 0.01}; }

CellState state_at(const OccupancyGrid& grid, double x, double y) {
  return grid.state(grid.cell_at({x, y}));
}

TEST(OccupancyGrid, ABeamMissesAlongItsRayAndHitsAtItsEnd) {
  OccupancyGrid grid(ten_centimetres());
  ASSERT_TRUE(grid.insert(one_beam(2.0F, 0.0), {0.05, 0.05, 0.0}));
  for (double x = 0.05; x < 2.0; x += 0.1) EXPECT_EQ(state_at(grid, x, 0.05), CellState::kFree);
  EXPECT_EQ(state_at(grid, 2.05, 0.05), CellState::kOccupied);
  EXPECT_EQ(state_at(grid, 2.15, 0.05), CellState::kUnknown);
  EXPECT_EQ(state_at(grid, 1.05, 0.15), CellState::kUnknown);
}

TEST(OccupancyGrid, TracesBeamsInEveryDirection) {
  for (double angle = -3.1; angle < 3.15; angle += 0.1) {
    OccupancyGrid grid(ten_centimetres());
    const Pose2 T_map_laser{-7.03, 4.04, angle};
    ASSERT_TRUE(grid.insert(one_beam(3.0F, 0.0), T_map_laser));
    const Eigen::Vector2d end = T_map_laser * Eigen::Vector2d(3.0, 0.0);
    const Eigen::Vector2d halfway = T_map_laser * Eigen::Vector2d(1.5, 0.0);
    EXPECT_EQ(grid.state(grid.cell_at(end)), CellState::kOccupied) << angle;
    EXPECT_EQ(grid.state(grid.cell_at(halfway)), CellState::kFree) << angle;
  }
}

TEST(OccupancyGrid, ACellHitInAScanIsNotMissedByItsOtherBeams) {
  OccupancyGrid grid(ten_centimetres());
  LaserScan grazing{0, {}, -0.01, 0.00002};
  for (int i = 0; i < 1000; ++i) grazing.ranges_m.push_back(i % 2 == 0 ? 2.0F : 3.0F);
  ASSERT_TRUE(grid.insert(grazing, {0.05, 0.05, 0.0}));
  EXPECT_DOUBLE_EQ(grid.occupancy(grid.cell_at({2.05, 0.05})), 1.0);
}

TEST(OccupancyGrid, OccupancyFallsWithMisses) {
  OccupancyGrid grid(ten_centimetres());
  ASSERT_TRUE(grid.insert(one_beam(2.0F, 0.0), {0.05, 0.05, 0.0}));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(grid.insert(one_beam(4.0F, 0.0), {0.05, 0.05, 0.0}));
  EXPECT_DOUBLE_EQ(grid.occupancy(grid.cell_at({2.05, 0.05})), 0.25);
  EXPECT_EQ(state_at(grid, 2.05, 0.05), CellState::kFree);
}

TEST(OccupancyGrid, IgnoresInvalidReadings) {
  OccupancyGrid grid({});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(grid.insert({0, {nan, infinity, -infinity, 0.0F, -1.0F, 81.83F}, 0.0, 0.1}, {}));
  ASSERT_TRUE(grid.insert({0, {}, 0.0, 0.1}, {}));
  ASSERT_TRUE(grid.insert(one_beam(1.0F, std::nan("")), {}));
  EXPECT_TRUE(grid.observed_box().empty());
}

TEST(OccupancyGrid, KeepsItsCellsWhenItGrows) {
  OccupancyGrid grid(ten_centimetres());
  for (const double x : {0.05, 500.05, -300.05}) {
    ASSERT_TRUE(grid.insert(one_beam(2.0F, 0.0), {x, 0.05, 0.0}));
  }
  for (const double x : {0.05, 500.05, -300.05}) {
    EXPECT_EQ(state_at(grid, x + 2.0, 0.05), CellState::kOccupied);
  }
  EXPECT_EQ(grid.observed_box().from, Eigen::Vector2i(-3001, 0));
  EXPECT_EQ(grid.observed_box().to, Eigen::Vector2i(5021, 1));
}

TEST(OccupancyGrid, RejectsPosesOutOfRange) {
  OccupancyGridParams params = ten_centimetres();
  params.cells_max = 1'000'000;
  OccupancyGrid grid(params);
  ASSERT_TRUE(grid.insert(one_beam(2.0F, 0.0), {}));
  EXPECT_FALSE(grid.insert(one_beam(2.0F, 0.0), {1e5, 1e5, 0.0}));
  EXPECT_FALSE(grid.insert(one_beam(2.0F, 0.0), {1e300, 0.0, 0.0}));
  EXPECT_FALSE(grid.insert(one_beam(2.0F, 0.0), {0.0, std::nan(""), 0.0}));
  EXPECT_EQ(state_at(grid, 2.05, 0.05), CellState::kOccupied);
}

}  // namespace
namespace {

using test::contents;

class MapServer : public testing::Test {
 protected:
  test::ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path();
};

TEST_F(MapServer, WritesShadesFromTheHighestRowDown) {
  OccupancyGridParams params;
  params.resolution_m = 1.0;
  OccupancyGrid grid(params);
  ASSERT_TRUE(grid.insert({0, {2.0F}, 0.0, 0.1}, {-3.5, 7.5, 1.57079632679}));  // upwards
  write_map_server(grid, folder_, "map");
  EXPECT_EQ(contents(folder_ / "map.pgm"),
            "P5\n3 5\n255\n"
            "\xCD\xCD\xCD"
            "\xCD" +
                std::string(1, '\0') +
                "\xCD"
                "\xCD\xFE\xCD"
                "\xCD\xFE\xCD"
                "\xCD\xCD\xCD");
  EXPECT_EQ(contents(folder_ / "map.yaml"),
            "image: map.pgm\nmode: trinary\nresolution: 1.000000\n"
            "origin: [-5.000000, 6.000000, 0.0]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST_F(MapServer, WritesAnEmptyMap) {
  write_map_server(OccupancyGrid({}), folder_, "map");
  EXPECT_EQ(contents(folder_ / "map.pgm"), "P5\n2 2\n255\n\xCD\xCD\xCD\xCD");
}

TEST_F(MapServer, NamesTheFileThatItCannotWrite) {
  EXPECT_THROW(write_map_server(OccupancyGrid({}), folder_ / "missing", "map"), std::runtime_error);
}

}  // namespace
}  // namespace adit
