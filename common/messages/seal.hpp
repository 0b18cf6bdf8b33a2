// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "adit/seal_nonce_t.hpp"

#include "common/messages/result.hpp"
#include "common/seal/seal_trailer.hpp"

namespace adit {

/// The challenge of a receiver of sealed orders on SEAL_CHALLENGE, and the answer of a sender on
/// SEAL_ANSWER; see SealReceiver.
struct SealChallenge {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  SealNonce nonce{};       ///< zero: a sender announces itself

  friend bool operator==(const SealChallenge&, const SealChallenge&) = default;
};

seal_nonce_t to_message(const SealChallenge& challenge);

/// Rejects an implausible time.
Result<SealChallenge> from_message(const seal_nonce_t& message);

}  // namespace adit
