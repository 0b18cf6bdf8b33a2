// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/association_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/association.hpp"

namespace adit {

association_t to_message(const Association& association);

/// Rejects an implausible time, an unknown action, negative ids, more alternatives than a message
/// of 60 kB can hold, an alternative that is not an older map or has an invalid pose, information
/// or likelihood, and a choice that is not among the alternatives.
Result<Association> from_message(const association_t& message);

}  // namespace adit
