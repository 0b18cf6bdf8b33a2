// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// The reliefs of one world, each of which is random by itself.
enum class ReliefKind : std::uint64_t {
  kFloor = 1,
  kRoof = 2,
  kWallInPlan = 3,
  kWallInHeight = 4,
};

/// The seed of a relief, from that of its world.
inline std::uint64_t seed_of(int world_seed, ReliefKind relief) {
  return static_cast<std::uint64_t>(world_seed) * 16U + static_cast<std::uint64_t>(relief);
}

}  // namespace adit
