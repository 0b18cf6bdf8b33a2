// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/contour_lines.hpp"

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>

#include <gdal_alg.h>
#include <gdal_priv.h>

#include "tools/survey/files/gdal_support.hpp"

namespace adit {
namespace {

struct DestroyGenerator {
  void operator()(void* generator) const {
    GDAL_CG_Destroy(static_cast<GDALContourGeneratorH>(generator));
  }
};

/// Rows of values, with NaN as no data: a value far from all others.
constexpr double kNoData = -1e30;

CPLErr add_line(double level, int count, double* x, double* y, void* lines) {
  ContourLine line{level, {}};
  for (int i = 0; i < count; ++i) line.points.emplace_back(x[i], y[i]);
  static_cast<std::vector<ContourLine>*>(lines)->push_back(std::move(line));
  return CE_None;
}

}  // namespace

double ContourLine::length_m() const {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

std::vector<ContourLine> contour_lines(const Raster& raster, double base, double interval) {
  prepare_gdal();
  std::vector<ContourLine> lines;
  std::unique_ptr<void, DestroyGenerator> generator(
      GDAL_CG_Create(raster.columns, raster.rows, TRUE, kNoData, interval, base, add_line, &lines));
  if (!generator) throw std::runtime_error("GDAL cannot draw contours");
  std::vector<double> row(static_cast<std::size_t>(raster.columns));
  const std::vector<float>& values = raster.bands.front().values;
  for (std::size_t r = 0; r < static_cast<std::size_t>(raster.rows); ++r) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const float value = values[r * row.size() + c];
      row[c] = value == value ? static_cast<double>(value) : kNoData;
    }
    if (GDAL_CG_FeedLine(static_cast<GDALContourGeneratorH>(generator.get()), row.data()) !=
        CE_None)
      throw std::runtime_error("GDAL cannot draw contours");
  }
  generator.reset();  // passes on the last lines
  // From pixels, whose first corner is (0, 0), to coordinates.
  for (ContourLine& line : lines) {
    for (Eigen::Vector2d& p : line.points)
      p = raster.north_west + raster.cell_m * Eigen::Vector2d(p.x(), -p.y());
  }
  return lines;
}

}  // namespace adit
