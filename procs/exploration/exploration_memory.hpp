// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/exploration/exploration_report.hpp"
#include "procs/exploration/barrier.hpp"
#include "procs/exploration/stub_register.hpp"

namespace adit {

/// What an exploration knows beside the map, and could not find in it again.
struct ExplorationMemory {
  std::vector<RememberedStub> stubs;  ///< by id
  std::vector<Barrier> barriers;
  ExplorationDecision::Kind kind = ExplorationDecision::Kind::kStay;  ///< of the last decision
  int target = ExplorationDecision::kNoStub;
  int newest_seen = -1;  ///< local map, when the pursuit of the target was last looked at
  bool returning = false;

  friend bool operator==(const ExplorationMemory&, const ExplorationMemory&) = default;
};

/// As lines of text, which come back with the same bits. What is no such line gives nothing.
std::string to_text(const RememberedStub& stub);
std::optional<RememberedStub> stub_from_text(std::string_view text);
std::string to_text(const std::vector<Barrier>& barriers);
std::optional<std::vector<Barrier>> barriers_from_text(std::string_view text);

}  // namespace adit
