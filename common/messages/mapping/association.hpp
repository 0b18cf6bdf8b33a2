// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/association_t.hpp"
#include "adit/map_contradictions_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/association.hpp"
#include "common/types/map_contradictions.hpp"

namespace adit {

association_t to_message(const Association& association);
/// At most the 1,000 with the most evidence.
map_contradictions_t to_message(const MapContradictions& contradictions);

/// Rejects an implausible time, an unknown action, negative ids, more alternatives than a message
/// of 60 kB can hold, an alternative that is not an older map or has an invalid pose, information
/// or likelihood, and a choice that is not among the alternatives.
Result<Association> from_message(const association_t& message);

/// Rejects an implausible time, more pairs than a message of 60 kB can hold, a pair that is not an
/// older and a newer map, and evidence that is not finite.
Result<MapContradictions> from_message(const map_contradictions_t& message);

}  // namespace adit
