// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/exploration_t.hpp"
#include "adit/explore_request_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/exploration.hpp"

namespace adit {

/// Limits the message to kFragmentBytes: frontiers that are not closed come first, then as many
/// corridors as fit. Sentences are truncated to kSentenceMax characters.
exploration_t to_message(const ExplorationReport& report);

inline constexpr std::size_t kSentenceMax = 300;

/// Rejects an implausible time, an unknown kind or state, a negative id, numbers that are not
/// finite, a corridor with missing nodes or fewer than two points, and totals below the number of
/// frontiers or corridors present. Sorts the frontiers by id.
Result<ExplorationReport> from_message(const exploration_t& message);

explore_request_t to_message(const ExploreRequest& request);

/// Rejects an implausible time, an id that is not positive, distances that are negative or not
/// finite.
Result<ExploreRequest> from_message(const explore_request_t& message);

}  // namespace adit
