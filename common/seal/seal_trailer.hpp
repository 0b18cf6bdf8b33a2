// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace adit {

/// 128 random bits: the name of a sender from its start to its end, or the question of a receiver.
using SealNonce = std::array<std::uint8_t, 16>;

/// The seal of a message. It travels behind the encoded message, where decoders of LCM ignore it:
/// session, sequence (big-endian), tag, "AditSeal".
struct SealTrailer {
  SealNonce session{};        ///< of the sender
  std::int64_t sequence = 0;  ///< clock of the sender [µs], strictly increasing in a session
  SealNonce tag{};            ///< keyed hash, see SealKey::tag

  static constexpr std::array<std::uint8_t, 8> kMark{'A', 'd', 'i', 't', 'S', 'e', 'a', 'l'};
  static constexpr std::size_t kBytes = 48;
};

/// A message with its seal.
struct SealedBytes {
  std::span<const std::uint8_t> message;
  SealTrailer seal;
};

/// The sequence as in the trailer.
inline std::array<std::uint8_t, 8> big_endian(std::int64_t sequence) {
  std::array<std::uint8_t, 8> bytes{};
  for (std::size_t i = 0; i < 8; ++i) {
    bytes[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(sequence) >> (56 - 8 * i));
  }
  return bytes;
}

inline std::vector<std::uint8_t> append_seal(std::span<const std::uint8_t> message,
                                             const SealTrailer& seal) {
  std::vector<std::uint8_t> bytes(message.begin(), message.end());
  const auto sequence = big_endian(seal.sequence);
  bytes.reserve(message.size() + SealTrailer::kBytes);
  bytes.insert(bytes.end(), seal.session.begin(), seal.session.end());
  bytes.insert(bytes.end(), sequence.begin(), sequence.end());
  bytes.insert(bytes.end(), seal.tag.begin(), seal.tag.end());
  bytes.insert(bytes.end(), SealTrailer::kMark.begin(), SealTrailer::kMark.end());
  return bytes;
}

/// Message and seal, unverified. Nothing if no trailer is present.
inline std::optional<SealedBytes> split_seal(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < SealTrailer::kBytes) return std::nullopt;
  const auto trailer = bytes.last<SealTrailer::kBytes>();
  if (!std::equal(SealTrailer::kMark.begin(), SealTrailer::kMark.end(), trailer.end() - 8)) {
    return std::nullopt;
  }
  SealedBytes parts;
  parts.message = bytes.first(bytes.size() - SealTrailer::kBytes);
  std::copy_n(trailer.begin(), 16, parts.seal.session.begin());
  std::uint64_t sequence = 0;
  for (const std::uint8_t byte : trailer.subspan<16, 8>()) sequence = sequence << 8 | byte;
  parts.seal.sequence = static_cast<std::int64_t>(sequence);
  std::copy_n(trailer.begin() + 24, 16, parts.seal.tag.begin());
  return parts;
}

/// The message without a seal, for who only reads it: logs, tools, processes without a key.
inline std::span<const std::uint8_t> without_seal(std::span<const std::uint8_t> bytes) {
  const auto parts = split_seal(bytes);
  return parts ? parts->message : bytes;
}

}  // namespace adit
