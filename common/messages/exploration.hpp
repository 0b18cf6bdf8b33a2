// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/exploration_t.hpp"
#include "adit/explore_request_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/exploration.hpp"

namespace adit {

/// As much as fits kFragmentBytes: the stubs that are not closed come first, of the corridors as
/// many as there is room for. Sentences are cut after kSentenceMax characters.
exploration_t to_message(const ExplorationReport& report);

inline constexpr std::size_t kSentenceMax = 300;

/// Refused: an implausible time, an unknown kind or state, a negative id, what is not finite, a
/// corridor between nodes that are not there or without its two ends, fewer stubs or corridors in
/// all than are there. The stubs come by id again.
Result<ExplorationReport> from_message(const exploration_t& message);

explore_request_t to_message(const ExploreRequest& request);

/// Refused: an implausible time, an id that is not positive, ways that are negative or not finite.
Result<ExploreRequest> from_message(const explore_request_t& message);

}  // namespace adit
