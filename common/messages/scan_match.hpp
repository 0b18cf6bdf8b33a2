// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/scan_match_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/scan_match.hpp"

namespace adit {

scan_match_t to_message(const ScanMatch& match);

/// Refused: implausible times, an unknown status or fill, a pose, covariance or direction that is
/// not finite, more than three degenerate directions.
Result<ScanMatch> from_message(const scan_match_t& message);

}  // namespace adit
