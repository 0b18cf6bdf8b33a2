// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/map_view.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/picture/legend.hpp"
#include "common/picture/palette.hpp"
#include "tools/report/html/text_format.hpp"
#include "tools/report/svg/indexed_png.hpp"

namespace adit {
namespace {

constexpr double kSideUnits = 1000.0;
constexpr double kUnitsPerMetreMax = 40.0;
constexpr double kMarginUnits = 78.0;  // for the numbers beside the path
constexpr int kPixelsMax = 2400;
constexpr double kWallAt = 0.4;  // occupancy that is drawn as a wall
constexpr double kShades = 8.0;
const RgbImage::Pixel kUnknownPixel{255, 0, 255};

/// The most occupied cell of a block counts.
RgbImage::Pixel pixel_of(const OccupancyGrid& grid, const Eigen::Vector2i& from, int block) {
  bool known = false;
  double occupancy = 0.0;
  for (int j = 0; j < block; ++j) {
    for (int i = 0; i < block; ++i) {
      const Eigen::Vector2i cell = from + Eigen::Vector2i(i, j);
      if (grid.state(cell) == CellState::kUnknown) continue;
      known = true;
      occupancy = std::max(occupancy, grid.occupancy(cell));
    }
  }
  if (!known) return kUnknownPixel;
  const double wall = std::min(1.0, occupancy / kWallAt);
  return rgb_pixel(blend(kOpen, kWall, std::round(wall * kShades) / kShades));
}

}  // namespace

MapView::MapView(const OccupancyGrid* grid, const Trajectory& path) {
  const bool known = grid != nullptr && !grid->observed_box().empty();
  low_ = high_ = path.empty() ? Eigen::Vector2d(0.0, 0.0) : path.front().pose.translation();
  if (known) {
    low_ = grid->resolution_m() * grid->observed_box().from.cast<double>();
    high_ = grid->resolution_m() * grid->observed_box().to.cast<double>();
  }
  for (const TimedPose& pose : path) {
    low_ = low_.cwiseMin(pose.pose.translation());
    high_ = high_.cwiseMax(pose.pose.translation());
  }
  const double longest_m = std::max((high_ - low_).maxCoeff(), 1.0);
  units_per_metre_ = std::min(kSideUnits / longest_m, kUnitsPerMetreMax);
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(kMarginUnits / units_per_metre_);
  low_ -= around;
  high_ += around;
}

std::string ground_svg(const OccupancyGrid& grid, const MapView& view) {
  const CellBox box = grid.observed_box();
  if (box.empty()) return "";
  const int block = (box.size().maxCoeff() + kPixelsMax - 1) / kPixelsMax;
  RgbImage image((box.size().x() + block - 1) / block, (box.size().y() + block - 1) / block);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Eigen::Vector2i from = box.from + block * Eigen::Vector2i(x, image.height - 1 - y);
      image.at(x, y) = pixel_of(grid, from, block);
    }
  }
  const double cell_m = block * grid.resolution_m();
  const Eigen::Vector2d corner =
      grid.resolution_m() * box.from.cast<double>() + Eigen::Vector2d(0.0, image.height * cell_m);
  const Eigen::Vector2d at = view.at(corner);
  const double units_per_pixel = cell_m * view.units_per_metre();
  return fmt::format(R"(<image class="ground" x="{}" y="{}" width="{}" height="{}" href="{}"/>)",
                     fixed(at.x(), 2), fixed(at.y(), 2), fixed(image.width * units_per_pixel, 2),
                     fixed(image.height * units_per_pixel, 2),
                     data_uri("image/png", indexed_png(image, kUnknownPixel)));
}

std::string scale_svg(const MapView& view, const Eigen::Vector2d& left) {
  const double length_m = scale_bar_m(std::max(view.width() / 4.0, 60.0) / view.units_per_metre());
  const double units = length_m * view.units_per_metre();
  const auto x = [&](double share) { return fixed(left.x() + share * units, 1); };
  return fmt::format(
      R"(<g class="scale"><path d="M{0} {3}v-6v12v-6H{2}v-6v12v-6M{1} {3}v-4"/>)"
      R"(<text x="{0}" y="{4}">0</text><text x="{2}" y="{4}" text-anchor="end">{5} m</text></g>)",
      x(0.0), x(0.5), x(1.0), fixed(left.y(), 1), fixed(left.y() - 10.0, 1),
      fixed(length_m, length_m < 1 ? 1 : 0));
}

}  // namespace adit
