// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "common/volume/cell_run.hpp"

namespace adit {

/// What is free and occupied, in OctoMap's binary form: what follows behind "data" in a .bt file
/// (Hornung et al. 2013, section 3.5). Each node that has children takes two bytes, two bits for
/// each child (01 free, 10 occupied, 11 has children itself, 00 unknown), then come the children
/// that have children. No bytes: nothing is known.
inline constexpr std::size_t kOctreeBytesMax = 4'000'000;

/// Gives the leaves along the curve. Returns nothing, or why it refused: damaged in a way that
/// shows, or longer than kOctreeBytesMax; then leaves may have been given before. OctoMap's own
/// reader takes damaged bytes for a tree, and more where the bytes end.
std::string_view visit_leaves(std::span<const std::uint8_t> octree,
                              const std::function<void(const CellRun&)>& visit);

struct OctreeCounts {
  std::int64_t occupied = 0;
  std::int64_t free = 0;
  std::string_view refusal;  ///< why there are none, if so
};

/// Counts the cells.
OctreeCounts count_cells(std::span<const std::uint8_t> octree);

}  // namespace adit
