// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/map_picture.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <cairo.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using test::contents;

/// A room of 20 m by 10 m, observed from its centre.
OccupancyGrid room() {
  OccupancyGrid grid({});
  LaserScan scan{0, {}, 0.0, 0.005};
  for (int i = 0; i < 1257; ++i) {
    const double angle = 0.005 * i;
    scan.ranges_m.push_back(static_cast<float>(
        std::min(10.0 / std::abs(std::cos(angle)), 5.0 / std::abs(std::sin(angle)))));
  }
  (void)grid.insert(scan, {});
  return grid;
}

class MapPng : public testing::Test {
 protected:
  std::pair<int, int> size() const {
    cairo_surface_t* image = cairo_image_surface_create_from_png(path_.c_str());
    const std::pair<int, int> result{cairo_image_surface_get_width(image),
                                     cairo_image_surface_get_height(image)};
    cairo_surface_destroy(image);
    return result;
  }

  test::ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "map.png";
};

TEST_F(MapPng, TheSameMapGivesTheSameBytes) {
  const MapPicture picture{"A room", {{0, 0, 0}, {1, 0, 0}, {2, 1, 1}}, {false, true, false}};
  write_map_png(room(), picture, path_);
  const std::string first = contents(path_);
  write_map_png(room(), picture, path_);
  EXPECT_EQ(first, contents(path_));
  EXPECT_GT(first.size(), 1000U);
}

TEST_F(MapPng, ShowsDoubtfulStretches) {
  MapPicture picture{"A room", {{0, 0, 0}, {1, 0, 0}, {2, 1, 1}}, {false, true, false}};
  write_map_png(room(), picture, path_);
  const std::string without = contents(path_);
  picture.doubtful = {true, true, false};
  write_map_png(room(), picture, path_);
  EXPECT_NE(without, contents(path_));
}

TEST_F(MapPng, ShowsDegenerateSegments) {
  MapPicture picture{"A room", {{0, 0, 0}, {1, 0, 0}, {2, 1, 1}}, {}};
  write_map_png(room(), picture, path_);
  const std::string without = contents(path_);
  picture.degenerate = {false, true, false};
  write_map_png(room(), picture, path_);
  EXPECT_NE(without, contents(path_));
}

TEST_F(MapPng, DrawsNoLineToTheStartOfAnotherSession) {
  MapPicture picture{"A room", {{-8, 0, 0}, {-7, 0, 0}, {7, 0, 0}, {8, 0, 0}}, {}};
  write_map_png(room(), picture, path_);
  const std::string joined = contents(path_);
  picture.jumps = {2};
  write_map_png(room(), picture, path_);
  EXPECT_NE(joined, contents(path_));
}

TEST_F(MapPng, ShowsEachKindOfPlace) {
  using Kind = MapPicture::Place::Kind;
  MapPicture picture{"A room", {{0, 0, 0}, {1, 0, 0}, {2, 1, 1}}, {}};
  std::set<std::string> pictures;
  const auto draw = [&] {
    write_map_png(room(), picture, path_);
    pictures.insert(contents(path_));
  };
  draw();
  for (const Kind kind : {Kind::kScan, Kind::kJunction, Kind::kDeadEnd, Kind::kBlockedFrontier,
                          Kind::kOpenFrontier}) {
    picture.places = {{{-3.0, 2.0}, kind}};
    draw();
  }
  EXPECT_EQ(pictures.size(), 6U);
}

TEST_F(MapPng, ShowsEachPartOfThePoseGraph) {
  MapPicture picture{"A room", {{0, 0, 0}, {1, 0, 0}, {2, 1, 1}}, {}};
  const GraphPicture::Edge edge{{0.0, 0.0}, {2.0, 1.0}};
  std::set<std::string> pictures;
  const auto draw = [&] {
    write_map_png(room(), picture, path_);
    pictures.insert(contents(path_));
  };
  draw();
  picture.graph.nodes = {{0, 0, 0}, {2, 1, 1}};
  draw();
  picture.graph.sequential = {edge};
  draw();
  picture.graph.loop_closures = {edge};
  draw();
  std::swap(picture.graph.loop_closures, picture.graph.revoked);
  draw();
  EXPECT_EQ(pictures.size(), 5U);
}

TEST_F(MapPng, ShowsAPoseGraphWithoutAPathAndBeyondTheMap) {
  MapPicture picture{"Far away", {}, {}};
  picture.graph.nodes = {{200.0, 0.0, 0.0}};
  write_map_png(room(), picture, path_);
  EXPECT_GT(size().first, 2 * size().second);
}

TEST_F(MapPng, HasRoomForTheLegendBelowANarrowMap) {
  MapPicture picture{"High", {{0, 0, 0}, {0, 900, 0}}, {true, true}};
  write_map_png(room(), picture, path_);
  const int width = size().first;
  const GraphPicture::Edge edge{{0.0, 0.0}, {0.0, 9.0}};
  picture.graph = {{{0, 0, 0}}, {edge}, {edge}, {edge}};
  write_map_png(room(), picture, path_);
  EXPECT_GT(size().first, width);
}

TEST_F(MapPng, StaysWithinItsMaximumSize) {
  write_map_png(room(), {"Wide", {{0, 0, 0}, {900, 0, 0}}, {}}, path_);
  EXPECT_LE(size().first, 2400);
  write_map_png(room(), {"High", {{0, 0, 0}, {0, 900, 0}}, {}}, path_);
  EXPECT_LE(size().second, 2400);
}

TEST_F(MapPng, DrawsAnEmptyMap) {
  write_map_png(OccupancyGrid({}), {"Nothing", {}, {}}, path_);
  write_map_png(OccupancyGrid({}), {"One pose", {{3, 4, 0}}, {true}}, path_);
  EXPECT_GT(size().first, 0);
}

TEST_F(MapPng, NamesTheFileThatItCannotWrite) {
  EXPECT_THROW(write_map_png(room(), {"A room", {}, {}}, "/nonexistent/map.png"),
               std::runtime_error);
}

}  // namespace
}  // namespace adit
