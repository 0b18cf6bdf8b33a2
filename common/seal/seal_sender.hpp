// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/seal/seal_key.hpp"
#include "common/seal/seal_trailer.hpp"

namespace adit {

/// Seals the messages of one process: a new session at each start, a sequence that follows the
/// clock.
class SealSender {
 public:
  explicit SealSender(const SealKey& key) : key_(key), session_(random_nonce()) {}

  /// The message with its seal. `now_us` is a clock that runs on while the computer sleeps and is
  /// never set [µs].
  std::vector<std::uint8_t> seal(std::string_view channel, std::span<const std::uint8_t> message,
                                 std::int64_t now_us);

 private:
  SealKey key_;
  SealNonce session_;
  std::int64_t last_ = 0;
};

}  // namespace adit
