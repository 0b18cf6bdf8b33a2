// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/map_layout.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr int kPixelsMax = 2400;
constexpr int kLongSideWanted = 1600;  // lettering and lines grow with sheets that are larger
constexpr double kPixelsPerMetreMax = 60.0;
constexpr int kWidthMin = 820;  // what the footer needs

}  // namespace

MapLayout::MapLayout(const OccupancyGrid& grid, const std::vector<Pose2>& poses, int keys)
    : cells(grid.known_box()),
      low(grid.resolution_m() * cells.from.cast<double>()),
      high(grid.resolution_m() * cells.to.cast<double>()) {
  if (cells.empty()) low = high = poses.empty() ? Eigen::Vector2d(0, 0) : poses[0].translation();
  for (const Pose2& pose : poses) {
    low = low.cwiseMin(pose.translation());
    high = high.cwiseMax(pose.translation());
  }
  low -= Eigen::Vector2d::Constant(1.0);
  high += Eigen::Vector2d::Constant(1.0);
  const Eigen::Vector2d size = high - low;
  // One cell is never more than a pixel or so smaller than needed, up to the limit of the sheet.
  const double finest = 1.0 / grid.resolution_m();
  const double wanted = std::max(finest, kLongSideWanted / size.maxCoeff());
  pixels_per_metre = std::min(wanted, kPixelsPerMetreMax);
  unit = std::clamp(pixels_per_metre * size.maxCoeff() / kLongSideWanted, 1.0,
                    static_cast<double>(kPixelsMax) / kLongSideWanted);
  const Eigen::Vector2d around = unit * Eigen::Vector2d(2.0 * kMargin, kHeader + kFooter);
  pixels_per_metre = std::min({pixels_per_metre, (kPixelsMax - around.x()) / size.x(),
                               (kPixelsMax - around.y()) / size.y()});
  const Eigen::Vector2d map = pixels_per_metre * size;
  const int width_min = kWidthMin + static_cast<int>(keys * kGraphKey * unit);
  width = std::max(width_min, static_cast<int>(map.x() + around.x()));
  height = static_cast<int>(map.y() + around.y());
  left = (width - map.x()) / 2.0;
  top = unit * kHeader;
}

}  // namespace adit
