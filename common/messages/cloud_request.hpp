// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/cloud_request_t.hpp"

#include "common/cloud/cloud_request.hpp"
#include "common/messages/result.hpp"

namespace adit {

cloud_request_t to_message(const CloudRequest& request);

/// Refused: an implausible time, also of a scan, no name, more scans than plausible.
Result<CloudRequest> from_message(const cloud_request_t& message);

}  // namespace adit
