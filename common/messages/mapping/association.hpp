// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/association_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/association.hpp"

namespace adit {

association_t to_message(const Association& association);

/// Refused: an implausible time, an unknown action, negative ids, more alternatives than a message
/// of 60 kB could hold, an alternative that is not an older map or has a pose, information or
/// likelihood that is none, and a choice that is not among the alternatives.
Result<Association> from_message(const association_t& message);

}  // namespace adit
