// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/terrain_made.hpp"

#include "common/messages/checks.hpp"

namespace adit {

terrain_made_t to_message(const TerrainMade& made) {
  terrain_made_t message;
  message.utime = made.utime;
  message.id = made.id;
  message.complete = made.complete ? 1 : 0;
  return message;
}

Result<TerrainMade> from_message(const terrain_made_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  return TerrainMade{message.utime, message.id, message.complete != 0};
}

}  // namespace adit
