// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/drive_command_t.hpp"

#include "common/messages/result.hpp"
#include "common/vehicle/drive_command.hpp"

namespace adit {

drive_command_t to_message(const DriveCommand& command);

/// Refused: an implausible time, a speed or curvature that is not finite.
Result<DriveCommand> from_message(const drive_command_t& message);

}  // namespace adit
