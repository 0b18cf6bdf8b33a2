// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/sinkage_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/ground_and_air.hpp"

namespace adit {

sinkage_t to_message(const SinkageReading& reading);

/// Refused: an implausible time, a depth that is negative or not finite.
Result<SinkageReading> from_message(const sinkage_t& message);

}  // namespace adit
