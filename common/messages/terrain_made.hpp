// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/terrain_made_t.hpp"

#include "common/messages/result.hpp"
#include "common/terrain/terrain_made.hpp"

namespace adit {

terrain_made_t to_message(const TerrainMade& made);

/// Refused: an implausible time.
Result<TerrainMade> from_message(const terrain_made_t& message);

}  // namespace adit
