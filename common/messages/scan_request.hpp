// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/scan_request_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/scan_request.hpp"

namespace adit {

scan_request_t to_message(const ScanRequest& request);

/// Refused: an implausible time, a negative id, a laser that is neither LASER_FRONT nor LASER_REAR.
Result<ScanRequest> from_message(const scan_request_t& message);

}  // namespace adit
