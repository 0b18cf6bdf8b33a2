// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/planned_path_t.hpp"

#include "common/messages/result.hpp"
#include "common/path/planned_path.hpp"

namespace adit {

/// Of the blocking cells the first that fit kPieceBytes, and the count of all: a person sees the
/// rest in the terrain. The points of a path are never cut.
planned_path_t to_message(const PlannedPath& path);

/// Refused: an implausible time, a negative id, an unknown outcome or reason, points without a path
/// or a path without points, what is not finite but for a clearance that is infinite and heights,
/// fewer blocking cells in all than are there.
Result<PlannedPath> from_message(const planned_path_t& message);

}  // namespace adit
