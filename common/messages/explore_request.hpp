// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/explore_request_t.hpp"

#include "common/messages/result.hpp"
#include "common/mission/explore_request.hpp"

namespace adit {

explore_request_t to_message(const ExploreRequest& request);

/// Refused: an implausible time, an id that is not positive, ways that are negative or not finite.
Result<ExploreRequest> from_message(const explore_request_t& message);

}  // namespace adit
