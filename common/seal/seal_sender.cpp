// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/seal/seal_sender.hpp"

#include <algorithm>

namespace adit {

std::vector<std::uint8_t> SealSender::seal(std::string_view channel,
                                           std::span<const std::uint8_t> message,
                                           std::int64_t now_us) {
  last_ = std::max(now_us, last_ + 1);
  SealTrailer seal{session_, last_, {}};
  seal.tag = key_.tag(channel, seal, message);
  return append_seal(message, seal);
}

}  // namespace adit
