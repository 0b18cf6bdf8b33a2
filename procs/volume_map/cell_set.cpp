// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/cell_set.hpp"

#include <algorithm>
#include <bit>

namespace adit {
namespace {

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

}  // namespace adit
