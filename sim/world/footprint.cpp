// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/pose2.hpp"
#include "sim/world/passable_raster.hpp"

namespace adit {
namespace {

Footprint footprint(const Vehicle& vehicle, const Pose2& T_cell_body) {
  constexpr double kSpacing = PassableRaster::kSide;
  const int along = static_cast<int>(std::ceil(vehicle.length_m / kSpacing));
  const int across = static_cast<int>(std::ceil(vehicle.width_m / kSpacing));
  Footprint squares;
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j <= across; ++j) {
      const Eigen::Vector2d p_body(vehicle.length_m * (static_cast<double>(i) / along - 0.5),
                                   vehicle.width_m * (static_cast<double>(j) / across - 0.5));
      const Eigen::Vector2d place = T_cell_body * p_body / PassableRaster::kSide;
      squares.push_back(
          {static_cast<int>(std::floor(place.x())), static_cast<int>(std::floor(place.y()))});
    }
  }
  std::sort(squares.begin(), squares.end());
  squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
  return squares;
}

}  // namespace

std::vector<Footprint> footprints(const Vehicle& vehicle, double heading_rad, double cell_m) {
  const std::array<double, 3> shifts{0.0, -cell_m / 3.0, cell_m / 3.0};
  constexpr std::array<double, 3> kTurns{0.0, -0.14, 0.14};  // headings are 0.46 rad apart at most
  std::vector<Footprint> ways;
  for (const double turn : kTurns) {
    for (const double x : shifts) {
      for (const double y : shifts) {
        ways.push_back(
            footprint(vehicle, {cell_m / 2.0 + x, cell_m / 2.0 + y, heading_rad + turn}));
      }
    }
  }
  return ways;
}

}  // namespace adit
