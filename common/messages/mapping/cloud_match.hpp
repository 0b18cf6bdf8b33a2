// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/cloud_match_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/cloud_match.hpp"

namespace adit {

cloud_match_t to_message(const CloudMatch& match);

/// Rejects implausible times, heights, distances and angles, ids that are not those of an older and
/// a newer local map, and a covariance that is not positive definite.
Result<CloudMatch> from_message(const cloud_match_t& message);

}  // namespace adit
