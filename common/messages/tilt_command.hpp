// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/tilt_command_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/tilt_command.hpp"

namespace adit {

tilt_command_t to_message(const TiltCommand& command);

/// Refused: an implausible time, an angle or rate that is not finite, a rate that is not positive.
Result<TiltCommand> from_message(const tilt_command_t& message);

}  // namespace adit
