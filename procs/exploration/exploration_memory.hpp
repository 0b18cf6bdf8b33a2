// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/types/exploration.hpp"
#include "procs/exploration/frontier/frontier_register.hpp"
#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// State of an exploration that cannot be recomputed from the map.
struct ExplorationMemory {
  std::vector<StoredFrontier> frontiers;  ///< by id
  std::vector<Barrier> barriers;
  ExplorationDecision::Kind kind = ExplorationDecision::Kind::kStay;  ///< of the last decision
  int target = ExplorationDecision::kNoFrontier;
  int pursuit_local_map = -1;  ///< newest local map at the last update of the pursuit
  bool returning = false;
  bool verify_walls = false;

  friend bool operator==(const ExplorationMemory&, const ExplorationMemory&) = default;
};

/// Conversion to lines of text and back, bit-exact. Empty for malformed text.
std::string to_text(const StoredFrontier& frontier);
std::optional<StoredFrontier> frontier_from_text(std::string_view text);
std::string to_text(const std::vector<Barrier>& barriers);
std::optional<std::vector<Barrier>> barriers_from_text(std::string_view text);

}  // namespace adit
