// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "tools/survey/files/geotiff_file.hpp"

namespace adit {

/// A line along which the values of a raster are equal.
struct ContourLine {
  double level = 0.0;
  std::vector<Eigen::Vector2d> points;  ///< in the coordinates of the raster

  [[nodiscard]] bool is_closed() const {
    return points.size() > 3 && (points.front() - points.back()).norm() < 1e-9;
  }
  [[nodiscard]] double length_m() const;
};

/// Contours of the first band of a raster at multiples of `interval` from `base`; none where it is
/// NaN. Throws std::runtime_error if GDAL fails.
std::vector<ContourLine> contour_lines(const Raster& raster, double base, double interval);

}  // namespace adit
