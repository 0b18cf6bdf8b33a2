// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/bus.hpp"

#include <stdexcept>
#include <string>

#include "common/text/message_text.hpp"

namespace adit {

void require_valid_channel(std::string_view channel) {
  if (is_channel_name(channel)) return;
  throw std::invalid_argument(quote(channel) + " is not a valid channel: 1 to 63 of A-Z 0-9 _");
}

}  // namespace adit
