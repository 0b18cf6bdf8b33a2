// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/stop_t.hpp"

#include "common/messages/result.hpp"
#include "common/vehicle/drive_command.hpp"

namespace adit {

stop_t to_message(const StopOrder& order);

/// Refused: an implausible time.
Result<StopOrder> from_message(const stop_t& message);

}  // namespace adit
