// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/drive_command.hpp"

#include "common/messages/checks.hpp"

namespace adit {

drive_command_t to_message(const DriveCommand& command) {
  drive_command_t message;
  message.utime = command.utime;
  message.speed_m_s = command.speed_m_s;
  message.curvature_1_m = command.curvature_1_m;
  return message;
}

Result<DriveCommand> from_message(const drive_command_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!std::isfinite(message.speed_m_s)) return Refused{"speed is not finite"};
  if (!std::isfinite(message.curvature_1_m)) return Refused{"curvature is not finite"};
  return DriveCommand{message.utime, message.speed_m_s, message.curvature_1_m};
}

}  // namespace adit
