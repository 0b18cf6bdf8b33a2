// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/recorded_config.hpp"

#include "common/bus/channels.hpp"
#include "common/messages/codec.hpp"

namespace adit {

std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events,
                                      std::vector<std::string>& warnings) {
  for (const LogEventView& event : events) {
    if (event.channel != channels::kConfig) continue;
    const auto message = decode<config_t>(event.data);
    if (!message) continue;
    const auto snapshot = from_message(*message);
    if (!snapshot) continue;
    if (auto lasers = recorded_section<Lasers>(*snapshot, Lasers::kSection, warnings)) {
      return lasers;
    }
  }
  return std::nullopt;
}

}  // namespace adit
