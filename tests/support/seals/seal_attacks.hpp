// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace adit {

/// How somebody on the network, who sees and withholds everything but has no key,
/// tries to have an order accepted.
enum class SealAttack {
  kUnsealed,     ///< no seal
  kOtherKey,     ///< sealed with another key
  kReplay,       ///< a recorded message, of any session and channel, delivered or not
  kReorder,      ///< a withheld message behind a newer one of its channel
  kDelay,        ///< a withheld message, the last of its channel, 4.5 s late
  kTruncate,     ///< a fresh message that lacks bytes at either end, or inside
  kFlip,         ///< a fresh message with one changed bit, in the message or its seal
  kWrongChannel  ///< a fresh message on another channel
};
inline constexpr std::array<const char*, 8> kSealAttackNames{
    "not sealed", "other key", "replayed",  "reordered",
    "delayed",    "truncated", "bit flips", "wrong channel"};

struct SealAttackCounts {
  std::array<std::int64_t, kSealAttackNames.size()> attempts{};
  std::array<std::int64_t, kSealAttackNames.size()> accepted{};
  std::int64_t genuine = 0;  ///< sent by known senders, and delivered in order
  std::int64_t genuine_accepted = 0;
  std::int64_t sender_starts = 0;
  std::int64_t receiver_starts = 0;
};

/// Two senders and a receiver, each on a computer of its own whose clock differs by up to ten days
/// and runs up to 500 ppm fast or slow, exchange orders and restart at random, under so many
/// attacks, with replayed challenges and answers in between. The same seed gives the same counts
/// but for the random numbers of sessions, challenges and keys.
SealAttackCounts attack_seals(std::int64_t attacks, std::uint64_t seed);

}  // namespace adit
