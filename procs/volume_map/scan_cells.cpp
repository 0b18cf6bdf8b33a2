// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/scan_cells.hpp"

#include <cmath>
#include <limits>

namespace adit {
namespace {

using Eigen::Vector3f;

/// The sum in this order, in single precision, as OctoMap has it.
double norm(const Vector3f& v) {
  return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
}

/// One axis along a ray.
struct Axis {
  double next_m = std::numeric_limits<double>::max();  ///< of the ray, up to the next cell
  double step_m = 0.0;                                 ///< of the ray, from cell to cell
  VoxelCode bits = 0;                                  ///< of codes that belong to the axis
  VoxelCode code_step = 0;                             ///< to the next cell, among these bits
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
          up ? ~kBits + 1 : ~kOne + 1};  // a carry passes over the bits of other axes
}

/// The cells from that of the origin to that before the end: Amanatides & Woo 1987, in the
/// arithmetic of OcTreeBaseImpl::computeRayKeys. Where rounding makes the ray miss the cell of its
/// end, its length ends it.
void add_ray(const VoxelGrid& grid, const Vector3f& origin, const VoxelGrid::Keys& keys,
             const Vector3f& end, VoxelCode end_code, CellSet& free) {
  VoxelCode code = VoxelGrid::code_of(keys);
  if (code == end_code) return;
  const Vector3f beam = end - origin;
  const auto length = static_cast<float>(norm(beam));
  Axis x = axis_of<0>(grid, keys.x(), origin.x(), beam.x() / length);
  Axis y = axis_of<1>(grid, keys.y(), origin.y(), beam.y() / length);
  Axis z = axis_of<2>(grid, keys.z(), origin.z(), beam.z() / length);

  double limit_m = std::numeric_limits<double>::max();  // the first cell counts in any case
  const auto leave_along = [&](Axis& axis) {
    if (axis.next_m > limit_m) return false;
    free.insert(code);
    axis.next_m += axis.step_m;
    code = (code & ~axis.bits) | (((code & axis.bits) + axis.code_step) & axis.bits);
    return code != end_code;
  };
  for (bool on = true; on; limit_m = static_cast<double>(length)) {
    if (x.next_m < y.next_m) {
      on = x.next_m < z.next_m ? leave_along(x) : leave_along(z);
    } else {
      on = y.next_m < z.next_m ? leave_along(y) : leave_along(z);
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
    const Vector3f cut =
        line.origin + beam / static_cast<float>(range_m) * static_cast<float>(range_max_m);
    if (const auto keys = grid.keys_of(cut)) {
      add_ray(grid, line.origin, *origin_keys, cut, VoxelGrid::code_of(*keys), cells.free);
    }
  }
}

}  // namespace adit
