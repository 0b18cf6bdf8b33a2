// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "common/types/cloud.hpp"
#include "common/volume/volume.hpp"
#include "common/volume/voxel_grid.hpp"

namespace adit {

/// A set of cells, one bit each, in blocks of 32 × 32 × 32 cells that are allocated on demand.
/// Cells that are neighbours in space are close in memory.
class CellSet {
 public:
  /// Returns whether the cell is new.
  bool insert(VoxelCode cell) {
    std::uint64_t& word = block_of(cell)[word_of(cell)];
    const std::uint64_t before = word;
    word |= bit_of(cell);
    return word != before;
  }

  [[nodiscard]] bool contains(VoxelCode cell) const;
  [[nodiscard]] std::size_t size() const;

 private:
  static constexpr unsigned kBlockBits = 15;
  using Block = std::array<std::uint64_t, 512>;

  static std::size_t word_of(VoxelCode cell) { return (cell >> 6U) % std::tuple_size_v<Block>; }
  static std::uint64_t bit_of(VoxelCode cell) { return std::uint64_t{1} << (cell % 64U); }

  /// Cached, as consecutive cells of a ray are mostly in the same block.
  Block& block_of(VoxelCode cell) {
    const VoxelCode number = cell >> kBlockBits;
    if (number != last_number_) find_block(number);
    return *last_block_;
  }
  void find_block(VoxelCode number);

  std::unordered_map<VoxelCode, std::unique_ptr<Block>>
      blocks_;  // by number along the space-filling curve
  VoxelCode last_number_ = ~VoxelCode{0};
  Block* last_block_ = nullptr;

  friend std::vector<CellRun> runs_of(const CellSet& free, const CellSet& occupied);
};

/// The cells of both sets as runs along the curve; a cell in both is occupied.
std::vector<CellRun> runs_of(const CellSet& free, const CellSet& occupied);

/// The cells that a scan observed.
struct ScanCells {
  CellSet free;                      ///< traversed by beams; may contain occupied cells
  CellSet occupied;                  ///< in which beams end
  std::int64_t rejected_points = 0;  ///< not finite, or outside the grid
};

/// Adds the cells of the beams of a line, from its origin to each of its points, in the frame of
/// the grid (Hornung et al. 2013, section 5.1). A beam longer than `range_max_m` is truncated there
/// and adds no occupied cell. A beam without return adds nothing: water and coal absorb beams at
/// any range.
///
/// The cells are those of octomap::OcTree::computeUpdate, bit for bit.
void add_line(const VoxelGrid& grid, const CloudLine& line, double range_max_m, ScanCells& cells);

}  // namespace adit
