// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/seal.hpp"

#include <algorithm>
#include <iterator>

#include "common/messages/fields/diagnostics_fields.hpp"

namespace adit {

seal_nonce_t to_message(const SealChallenge& challenge) {
  seal_nonce_t message;
  message.utime = challenge.utime;
  std::copy(challenge.nonce.begin(), challenge.nonce.end(), std::begin(message.nonce));
  return message;
}

Result<SealChallenge> from_message(const seal_nonce_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  SealChallenge challenge{message.utime, {}};
  std::copy(std::begin(message.nonce), std::end(message.nonce), challenge.nonce.begin());
  return challenge;
}

}  // namespace adit
