// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/map_image.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/grid/occupancy_grid.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

class MapImage : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& contents) const {
    std::ofstream(folder_ / name, std::ios::binary) << contents;
  }
  [[nodiscard]] std::vector<Eigen::Vector2d> read() const {
    return read_occupied_cells(folder_ / "map.yaml");
  }
  [[nodiscard]] std::string rejection() const {
    try {
      (void)read();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder folder_;
};

constexpr const char* kYaml =
    "image: map.pgm\nmode: trinary\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

TEST_F(MapImage, ReturnsTheCentresOfOccupiedCells) {
  write("map.yaml", kYaml);
  // 3 × 2: the upper row unknown, occupied, free; the lower one free, free, occupied.
  write("map.pgm", std::string("P5\n3 2\n255\n") + '\xcd' + '\0' + '\xfe' + '\xfe' + '\xfe' + '\0');
  const auto occupied = read();
  ASSERT_EQ(occupied.size(), 2U);
  EXPECT_EQ(occupied[0], Eigen::Vector2d(-0.25, 2.75));
  EXPECT_EQ(occupied[1], Eigen::Vector2d(0.25, 2.25));
}

TEST_F(MapImage, SkipsTheCommentOfMapSaver) {
  write("map.yaml", kYaml);
  write("map.pgm", std::string("P5\n# CREATOR: map_saver.cpp 0.500 m/pix\n1 1\n255\n") + '\0');
  EXPECT_EQ(read().size(), 1U);
}

TEST_F(MapImage, ReadsTheMapOfAGrid) {
  OccupancyGrid grid({.resolution_m = 0.05});
  ASSERT_TRUE(grid.insert({0, {2.0F, 3.0F}, 0.0, 1.5}, {1.0, 1.0, 0.25}));
  write_map_server(grid, folder_.path(), "map");
  const auto occupied = read();
  ASSERT_EQ(occupied.size(), 2U);
  const Pose2 T_map_laser{1.0, 1.0, 0.25};
  for (const Eigen::Vector2d& end :
       {T_map_laser * Eigen::Vector2d(2.0, 0.0),
        T_map_laser * Eigen::Vector2d(3.0 * std::cos(1.5), 3.0 * std::sin(1.5))}) {
    EXPECT_TRUE(std::any_of(occupied.begin(), occupied.end(), [&](const auto& p) {
      return (p - end).cwiseAbs().maxCoeff() <= 0.025 + 1e-6;  // half a cell, ranges are floats
    }));
  }
}

TEST_F(MapImage, ReportsErrors) {
  using testing::HasSubstr;
  EXPECT_THAT(rejection(), HasSubstr("cannot read"));
  write("map.yaml", kYaml);
  EXPECT_THAT(rejection(), HasSubstr("cannot read"));  // the image
  write("map.pgm", "P6\n3 2\n255\n");
  EXPECT_THAT(rejection(), HasSubstr("map.pgm: is not a binary PGM"));
  write("map.pgm", "P5\n3 2\n255\nabc");
  EXPECT_THAT(rejection(), HasSubstr("map.pgm: has a different number of pixels"));
  write("map.yaml", "resolution: 0.05\n");
  EXPECT_THAT(rejection(), HasSubstr("map.yaml: has no image"));
  write("map.yaml", "image: map.pgm\nresolution: fine\n");
  EXPECT_THAT(rejection(), HasSubstr("cannot use 'fine' as resolution"));
  write("map.yaml", "image: map.pgm\nresolution: -1\n");
  EXPECT_THAT(rejection(), HasSubstr("not positive"));
}

}  // namespace
}  // namespace adit
