// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/scan_cells.hpp"

#include <cmath>
#include <limits>

namespace adit {
namespace {

using Eigen::Vector3f;

/// The sum in this order and in single precision, as in OctoMap.
double norm(const Vector3f& v) {
  return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
}

/// State of one axis of the traversal.
struct Axis {
  double next_m = std::numeric_limits<double>::max();  ///< up to the next cell boundary
  double step_m = 0.0;                                 ///< length of the ray per cell
  VoxelCode bits = 0;                                  ///< bits of a code that belong to the axis
  VoxelCode code_step = 0;                             ///< step to the next cell, within these bits
};

template <unsigned kAxis>
Axis axis_of(const VoxelGrid& grid, int key, float origin, float direction) {
  constexpr VoxelCode kOne = VoxelCode{1} << kAxis;
  constexpr VoxelCode kBits = spread_bits(0xFFFFU) << kAxis;
  if (direction == 0.0F) return {};
  const bool up = direction > 0.0F;
  const auto half = static_cast<float>((up ? 0.5 : -0.5) * grid.cell_m());
  const double border = grid.centre_m(key) + static_cast<double>(half);
  return {(border - static_cast<double>(origin)) / static_cast<double>(direction),
          grid.cell_m() / std::abs(static_cast<double>(direction)), kBits,
          up ? ~kBits + 1 : ~kOne + 1};  // a carry propagates over the bits of other axes
}

/// Adds the cells from the origin to the one before the end (Amanatides and Woo 1987), in the
/// arithmetic of OcTreeBaseImpl::computeRayKeys. The length of the ray ends it if it misses the
/// cell of its end by rounding.
void add_ray(const VoxelGrid& grid, const Vector3f& origin, const VoxelGrid::Keys& keys,
             const Vector3f& end, VoxelCode end_code, CellSet& free) {
  VoxelCode code = VoxelGrid::code_of(keys);
  if (code == end_code) return;
  const Vector3f beam = end - origin;
  const auto length = static_cast<float>(norm(beam));
  Axis x = axis_of<0>(grid, keys.x(), origin.x(), beam.x() / length);
  Axis y = axis_of<1>(grid, keys.y(), origin.y(), beam.y() / length);
  Axis z = axis_of<2>(grid, keys.z(), origin.z(), beam.z() / length);

  double limit_m = std::numeric_limits<double>::max();  // the first cell always counts
  const auto step_along = [&](Axis& axis) {
    if (axis.next_m > limit_m) return false;
    free.insert(code);
    axis.next_m += axis.step_m;
    code = (code & ~axis.bits) | (((code & axis.bits) + axis.code_step) & axis.bits);
    return code != end_code;
  };
  for (bool proceed = true; proceed; limit_m = static_cast<double>(length)) {
    if (x.next_m < y.next_m) {
      proceed = x.next_m < z.next_m ? step_along(x) : step_along(z);
    } else {
      proceed = y.next_m < z.next_m ? step_along(y) : step_along(z);
    }
  }
}

}  // namespace

void add_line(const VoxelGrid& grid, const CloudLine& line, double range_max_m, ScanCells& cells) {
  const auto origin_keys = grid.keys_of(line.origin);
  for (const Vector3f& point : line.points) {
    const auto point_keys = grid.keys_of(point);
    if (!origin_keys || !point_keys) {
      ++cells.rejected_points;
      continue;
    }
    const Vector3f beam = point - line.origin;
    const double range_m = norm(beam);
    if (range_m <= range_max_m) {
      const VoxelCode end = VoxelGrid::code_of(*point_keys);
      add_ray(grid, line.origin, *origin_keys, point, end, cells.free);
      cells.occupied.insert(end);
      continue;
    }
    const Vector3f truncated =
        line.origin + beam / static_cast<float>(range_m) * static_cast<float>(range_max_m);
    if (const auto keys = grid.keys_of(truncated)) {
      add_ray(grid, line.origin, *origin_keys, truncated, VoxelGrid::code_of(*keys), cells.free);
    }
  }
}

}  // namespace adit
