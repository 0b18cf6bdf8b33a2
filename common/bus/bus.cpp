// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/bus.hpp"

#include <algorithm>
#include <stdexcept>

namespace adit {

void require_channel(std::string_view channel) {
  constexpr std::size_t kLongest = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH
  const bool plain = std::all_of(channel.begin(), channel.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!plain || channel.empty() || channel.size() > kLongest) {
    throw std::invalid_argument("'" + std::string(channel) +
                                "' is no channel: 1 to 63 of A-Z 0-9 _");
  }
}

}  // namespace adit
