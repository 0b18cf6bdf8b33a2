// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/gas_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/ground_and_air.hpp"

namespace adit {

gas_t to_message(const GasReading& reading);

/// Refused: an implausible time, a share beyond 0 to 1.
Result<GasReading> from_message(const gas_t& message);

}  // namespace adit
