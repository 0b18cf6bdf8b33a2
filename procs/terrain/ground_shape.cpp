// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/ground_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr int kReach = 2;        // cells to either side of the middle
constexpr int kPlaneCells = 20;  // that a plane needs: at the edge of the view a rail is no slope
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

template <class Visit>
void visit_seen(const TerrainMap& map, int column, int row, int reach, const Visit& visit) {
  const int first = std::max(column - reach, 0);
  const int last = std::min(column + reach, map.columns - 1);
  for (int r = std::max(row - reach, 0); r <= std::min(row + reach, map.rows - 1); ++r) {
    for (int c = first; c <= last; ++c) {
      const TerrainCell& cell = map.at(c, r);
      if (cell.ground == Ground::kSeen) {
        visit(static_cast<float>(c - column), static_cast<float>(r - row), cell.low_m);
      }
    }
  }
}

/// Sums for the normal equations of z = z0 + a x + b y, in cells.
struct PlaneSums {
  float n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

  void add(float u, float v, float w) {
    n += 1, x += u, y += v, z += w;
    xx += u * u, xy += u * v, yy += v * v, xz += u * w, yz += v * w;
  }
  /// Rise for each cell along the steepest way.
  [[nodiscard]] float grade() const {
    const float cxx = n * xx - x * x;
    const float cxy = n * xy - x * y;
    const float cyy = n * yy - y * y;
    const float cxz = n * xz - x * z;
    const float cyz = n * yz - y * z;
    const float determinant = cxx * cyy - cxy * cxy;
    return std::hypot(cyy * cxz - cxy * cyz, cxx * cyz - cxy * cxz) / determinant;
  }
};

/// Twenty of 5 × 5 cells are never all in a line, so that a plane through them is one.
float slope_rad(const TerrainMap& map, int column, int row) {
  const float middle = map.at(column, row).low_m;  // keeps the sums small, and so exact
  PlaneSums sums;
  visit_seen(map, column, row, kReach,
             [&](float u, float v, float z) { sums.add(u, v, z - middle); });
  if (sums.n < kPlaneCells) return kUnknown;
  return std::atan(sums.grade() / static_cast<float>(map.cell_m));
}

float step_m(const TerrainMap& map, int column, int row) {
  const float middle = map.at(column, row).low_m;
  float step = 0.0F;
  int seen = -1;  // the cell itself is none of its neighbours
  visit_seen(map, column, row, 1, [&](float, float, float z) {
    step = std::max(step, std::abs(z - middle));
    ++seen;
  });
  return seen > 0 ? step : kUnknown;
}

}  // namespace

void set_slope_and_step(TerrainMap& map) {
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      TerrainCell& cell = map.at(column, row);
      const bool seen = cell.ground == Ground::kSeen;
      cell.slope_rad = seen ? slope_rad(map, column, row) : kUnknown;
      cell.step_m = seen ? step_m(map, column, row) : kUnknown;
    }
  }
}

}  // namespace adit
