// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/tunnel_grid.hpp"

#include <algorithm>

#include "tools/sample_mine/rock.hpp"
#include "tools/sample_mine/wall_contour.hpp"

namespace adit {
namespace {

using Point = Eigen::Vector2d;
using Corner = Eigen::Vector2i;  // of blocks, counted from the origin

constexpr int kColumns = 8;
constexpr int kRows = 7;
const Point kBlock{40.0, 30.0};
constexpr double kHalfWidth = 1.7;

Point place_of(const Corner& corner) { return corner.cast<double>().cwiseProduct(kBlock); }

/// Only the two drifts nearest to a point matter, so the rock is asked in one cell of the grid.
class GridRock {
 public:
  explicit GridRock(std::uint64_t seed) : roughness_(seed) {}

  double operator()(const Point& p) const {
    const Point end = place_of({kColumns, kRows});
    const Point inside = p.cwiseMax(Point::Zero()).cwiseMin(end);
    const Point whole = inside.cwiseQuotient(kBlock).array().round().matrix().cwiseProduct(kBlock);
    const double to_upright = Point(p.x() - whole.x(), p.y() - inside.y()).norm();
    const double to_level = Point(p.x() - inside.x(), p.y() - whole.y()).norm();
    return roughness_(std::min(to_upright, to_level) - kHalfWidth, p);
  }

 private:
  Roughness roughness_;
};

/// Once through all blocks, from the origin to the corner above the last block.
std::vector<Corner> round_of_all_blocks() {
  std::vector<Corner> corners;
  for (int row = 0; row < kRows; ++row) {
    const bool eastward = row % 2 == 0;
    const int step = eastward ? 1 : -1;
    for (int i = 0; i < kColumns; ++i) {
      const Corner here(eastward ? i : kColumns - i, row);
      const Corner along(step, 0);
      const Corner up(0, 1);
      for (const Corner& corner : {Corner(here + along), Corner(here + along + up),
                                   Corner(here + up), here, Corner(here + along)}) {
        corners.push_back(corner);
      }
    }
    corners.push_back({eastward ? kColumns : 0, row + 1});
  }
  return corners;
}

}  // namespace

SyntheticWorld tunnel_grid(std::uint64_t seed) {
  const Point margin(4.0, 4.0);
  return SyntheticWorld(
      zero_contour(GridRock(seed), -margin, place_of({kColumns, kRows}) + margin, 0.2));
}

std::vector<Eigen::Vector2d> tunnel_grid_route(double length_min_m) {
  std::vector<Point> route = {place_of({0, 0})};
  double length_m = 0.0;
  const auto go_to = [&](const Corner& corner) {
    length_m += (place_of(corner) - route.back()).norm();
    route.push_back(place_of(corner));
  };
  while (length_m < length_min_m) {
    for (const Corner& corner : round_of_all_blocks()) go_to(corner);
    go_to({0, kRows});  // down the side, to where it began
    go_to({0, 0});
  }
  return route;
}

}  // namespace adit
