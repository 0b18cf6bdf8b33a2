// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/map_request_t.hpp"

#include "common/messages/result.hpp"
#include "common/mission/map_request.hpp"

namespace adit {

map_request_t to_message(const MapRequest& request);

/// Refused: an implausible time, no name.
Result<MapRequest> from_message(const map_request_t& message);

}  // namespace adit
