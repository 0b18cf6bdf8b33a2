// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/map_correction_t.hpp"

#include "common/messages/result.hpp"
#include "common/pose_graph/map_correction.hpp"

namespace adit {

map_correction_t to_message(const MapCorrection& correction);

/// Refused: an implausible time, a negative revision, session or id, a pose that is not finite, a
/// covariance matrix that is none.
Result<MapCorrection> from_message(const map_correction_t& message);

}  // namespace adit
