// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/derived_layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/grid/ground_trend.hpp"

namespace adit {
namespace {

/// Cells to each side of the centre: the plane is as wide as a wheel and a half, so that a seam of
/// 2 cm between two scans is a slope of 3 %.
constexpr int kPlaneReach = 4;
/// Cells that a plane needs: more than six rows of nine. At the edge of the observed ground often
/// only the rails are observed, as two rows of cells, and their height over few rows would pass for
/// a slope.
constexpr int kPlaneCells = 55;
constexpr float kUndefined = std::numeric_limits<float>::quiet_NaN();

template <class Visit>
void visit_observed(const TerrainMap& map, int column, int row, int reach, const Visit& visit) {
  const int first = std::max(column - reach, 0);
  const int last = std::min(column + reach, map.cells.columns() - 1);
  for (int r = std::max(row - reach, 0); r <= std::min(row + reach, map.cells.rows() - 1); ++r) {
    std::size_t i = map.cells.index({first, r});
    for (int c = first; c <= last; ++c, ++i) {
      const TerrainCell& cell = map.cells[i];
      if (cell.ground == Ground::kObserved) {
        visit(static_cast<float>(c - column), static_cast<float>(r - row), cell.low_m);
      }
    }
  }
}

/// Sums of the normal equations of z = z0 + a x + b y, in cells.
struct PlaneSums {
  float n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

  void add(float u, float v, float w) {
    n += 1, x += u, y += v, z += w;
    xx += u * u, xy += u * v, yy += v * v, xz += u * w, yz += v * w;
  }
  /// Rise per cell in the direction of steepest ascent.
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

float slope_rad(const TerrainMap& map, int column, int row) {
  const float middle = map.cells.at({column, row}).low_m;  // keeps the sums small, and thus exact
  PlaneSums sums;
  visit_observed(map, column, row, kPlaneReach,
                 [&](float u, float v, float z) { sums.add(u, v, z - middle); });
  if (sums.n < kPlaneCells) return kUndefined;
  return std::atan(sums.grade() / static_cast<float>(map.cell_m));
}

float step_m(const TerrainMap& map, const Eigen::Vector2f& rise_m, int column, int row) {
  const float middle = map.cells.at({column, row}).low_m;
  float step = 0.0F;
  int neighbours = -1;  // excludes the cell itself
  visit_observed(map, column, row, 1, [&](float u, float v, float z) {
    step = std::max(step, std::abs(z - middle - rise_m.x() * u - rise_m.y() * v));
    ++neighbours;
  });
  return neighbours > 0 ? step : kUndefined;
}

}  // namespace

void set_slope_and_step(TerrainMap& map) {
  const GroundTrend trend(map.ground_m(), map.cell_m);
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 0; column < map.cells.columns(); ++column) {
      TerrainCell& cell = map.cells.at({column, row});
      const bool observed = cell.ground == Ground::kObserved;
      cell.slope_rad = observed ? slope_rad(map, column, row) : kUndefined;
      cell.step_m = observed ? step_m(map, trend.rise_m(column, row), column, row) : kUndefined;
    }
  }
}

namespace {

/// The cone, row by row from −reach to reach.
class Kernel {
 public:
  Kernel(double radius_m, double cell_m)
      : reach_(std::max(static_cast<int>(std::ceil(radius_m / cell_m)) - 1, 0)) {
    double half = 0.0;  // weight of a half-plane whose edge is at the centre
    for (int y = -reach_; y <= reach_; ++y) {
      for (int x = -reach_; x <= reach_; ++x) {
        const double distance_m = cell_m * std::hypot(x, y);
        const double weight = distance_m == 0.0 ? 1.0 : std::max(1.0 - distance_m / radius_m, 0.0);
        weights_.push_back(static_cast<float>(weight));
        if (x >= 0) half += weight;
      }
    }
    for (float& weight : weights_) weight /= static_cast<float>(half);
  }

  [[nodiscard]] int reach() const { return reach_; }
  [[nodiscard]] const float* row(int y) const {
    const auto side = 2 * static_cast<std::size_t>(reach_) + 1;
    return weights_.data() + static_cast<std::size_t>(y + reach_) * side + reach_;
  }

 private:
  int reach_;
  std::vector<float> weights_;
};

void add_cone(Grid2<float>& sums, float coefficient, int column, int row, const Kernel& kernel) {
  const int first = std::max(column - kernel.reach(), 0);
  const int last = std::min(column + kernel.reach(), sums.columns() - 1);
  const int top = std::min(row + kernel.reach(), sums.rows() - 1);
  for (int r = std::max(row - kernel.reach(), 0); r <= top; ++r) {
    const float* weights = kernel.row(r - row) - column;
    float* out = &sums.at({0, r});
    for (int c = first; c <= last; ++c) out[c] += coefficient * weights[c];
  }
}

}  // namespace

void set_repulsion(TerrainMap& map, const RepulsionParams& params) {
  const Kernel kernel(params.radius_m, map.cell_m);
  const auto least = static_cast<float>(params.coefficient_min_m);
  Grid2<float> sums(map.cells.box());
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 0; column < map.cells.columns(); ++column) {
      const float coefficient = map.cells.at({column, row}).coefficient_m;
      if (coefficient >= least) add_cone(sums, coefficient, column, row, kernel);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) map.cells[i].repulsion_m = sums[i];
}

}  // namespace adit
