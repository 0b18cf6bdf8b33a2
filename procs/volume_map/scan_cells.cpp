// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/scan_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace adit {
namespace {

using Eigen::Vector3f;

/// Collects runs and merges adjacent ones.
class RunList {
 public:
  void add(VoxelCode first, VoxelCode end, bool occupied) {
    if (!runs_.empty() && runs_.back().end == first && runs_.back().occupied == occupied) {
      runs_.back().end = end;
    } else {
      runs_.push_back({first, end, occupied});
    }
  }

  /// Adds the 64 cells from `first` on.
  void add_word(VoxelCode first, std::uint64_t free, std::uint64_t occupied) {
    free &= ~occupied;
    for (int i = 0; (free | occupied) != 0;) {
      const int gap = std::countr_zero(free | occupied);
      free >>= static_cast<unsigned>(gap);
      occupied >>= static_cast<unsigned>(gap);
      const bool is_occupied = occupied % 2U != 0;
      std::uint64_t& bits = is_occupied ? occupied : free;
      const int n = std::countr_one(bits);
      i += gap;
      add(first + static_cast<VoxelCode>(i), first + static_cast<VoxelCode>(i + n), is_occupied);
      i += n;
      if (n == 64) return;
      free >>= static_cast<unsigned>(n);
      occupied >>= static_cast<unsigned>(n);
    }
  }

  std::vector<CellRun> take() { return std::move(runs_); }

 private:
  std::vector<CellRun> runs_;
};

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

bool CellSet::contains(VoxelCode cell) const {
  const auto block = blocks_.find(cell >> kBlockBits);
  return block != blocks_.end() && ((*block->second)[word_of(cell)] & bit_of(cell)) != 0;
}

std::size_t CellSet::size() const {
  std::size_t n = 0;
  for (const auto& [number, block] : blocks_) {
    for (const std::uint64_t word : *block) n += static_cast<std::size_t>(std::popcount(word));
  }
  return n;
}

void CellSet::find_block(VoxelCode number) {
  auto& block = blocks_[number];
  if (!block) block = std::make_unique<Block>();
  last_number_ = number;
  last_block_ = block.get();
}

std::vector<CellRun> runs_of(const CellSet& free, const CellSet& occupied) {
  std::vector<VoxelCode> numbers;
  for (const auto& [number, block] : free.blocks_) numbers.push_back(number);
  for (const auto& [number, block] : occupied.blocks_) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());

  static const CellSet::Block kNothing{};
  const auto find = [](const CellSet& set, VoxelCode number) -> const CellSet::Block& {
    const auto block = set.blocks_.find(number);
    return block == set.blocks_.end() ? kNothing : *block->second;
  };
  RunList runs;
  for (const VoxelCode number : numbers) {
    const CellSet::Block& free_block = find(free, number);
    const CellSet::Block& occupied_block = find(occupied, number);
    for (std::size_t i = 0; i < free_block.size(); ++i) {
      runs.add_word((number << CellSet::kBlockBits) + 64 * i, free_block[i], occupied_block[i]);
    }
  }
  return runs.take();
}

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
