// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/scan_cells.hpp"

#include <array>
#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

using Eigen::Vector3f;

constexpr std::array<VoxelCode, 3> kAxisBits{0x249249249249U, 0x492492492492U, 0x924924924924U};

/// The sum in this order, in single precision, as OctoMap has it.
double norm(const Vector3f& v) {
  return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
}

/// Where a ray crosses into the next cell along one axis, by its length so far [m], and what this
/// does to the code of the cell.
struct Axis {
  double next = std::numeric_limits<double>::max();
  double step = std::numeric_limits<double>::max();
  VoxelCode code_step = 0;
};

Axis axis_of(const VoxelGrid& grid, int i, int key, float origin, float direction) {
  if (direction == 0.0F) return {};
  const bool up = direction > 0.0F;
  const auto half = static_cast<float>((up ? 1 : -1) * grid.cell_m() * 0.5);
  const double border = grid.centre_m(key) + static_cast<double>(half);
  const VoxelCode bits = kAxisBits[static_cast<std::size_t>(i)];
  const VoxelCode one = bits & (~bits + 1);
  return {(border - static_cast<double>(origin)) / static_cast<double>(direction),
          grid.cell_m() / std::abs(static_cast<double>(direction)),
          up ? ~bits + 1 : ~one + 1};
}

/// The cells from that of the origin to that before the end: Amanatides & Woo 1987, in the
/// arithmetic of OcTreeBaseImpl::computeRayKeys. Steps are taken without branches, of which the
/// processor could foresee none.
void add_ray(const VoxelGrid& grid, const Vector3f& origin, const VoxelGrid::Keys& origin_keys,
             const Vector3f& end, VoxelCode end_code, CellSet& free) {
  VoxelCode code = VoxelGrid::code_of(origin_keys);
  if (code == end_code) return;
  Vector3f direction = end - origin;
  const auto length = static_cast<float>(norm(direction));
  direction /= length;
  Axis x = axis_of(grid, 0, origin_keys.x(), origin.x(), direction.x());
  Axis y = axis_of(grid, 1, origin_keys.y(), origin.y(), direction.y());
  Axis z = axis_of(grid, 2, origin_keys.z(), origin.z(), direction.z());
  const double length_m = static_cast<double>(length);
  VoxelCode cx = code & kAxisBits[0];
  VoxelCode cy = code & kAxisBits[1];
  VoxelCode cz = code & kAxisBits[2];
  do {
    free.insert(code);
    const bool x_first = (x.next < y.next) & (x.next < z.next);
    const bool y_first = !(x.next < y.next) & (y.next < z.next);
    const bool z_first = !(x_first | y_first);
    x.next += x_first ? x.step : 0.0;
    y.next += y_first ? y.step : 0.0;
    z.next += z_first ? z.step : 0.0;
    cx = (cx + (x_first ? x.code_step : 0)) & kAxisBits[0];
    cy = (cy + (y_first ? y.code_step : 0)) & kAxisBits[1];
    cz = (cz + (z_first ? z.code_step : 0)) & kAxisBits[2];
    code = cx | cy | cz;
  } while (code != end_code && !(std::min(std::min(x.next, y.next), z.next) > length_m));
}

}  // namespace

void add_line(const VoxelGrid& grid, const CloudLine& line, double range_max_m, ScanCells& cells) {
  const auto origin_keys = grid.keys_of(line.origin);
  if (!origin_keys) {
    cells.refused_points += static_cast<std::int64_t>(line.points.size());
    return;
  }
  for (const Vector3f& point : line.points) {
    const Vector3f beam = point - line.origin;
    const double range_m = norm(beam);
    const bool cut = !(range_m <= range_max_m);
    const Vector3f end =
        cut ? Vector3f(line.origin + beam / static_cast<float>(range_m) *
                                         static_cast<float>(range_max_m))
            : point;
    const auto end_keys = grid.keys_of(end);
    if (!end_keys) {
      ++cells.refused_points;
      continue;
    }
    const VoxelCode end_code = VoxelGrid::code_of(*end_keys);
    add_ray(grid, line.origin, *origin_keys, end, end_code, cells.free);
    if (!cut) cells.occupied.insert(end_code);
  }
}

}  // namespace adit
