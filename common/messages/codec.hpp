// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <climits>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/messages/result.hpp"
#include "common/seal/seal_trailer.hpp"

namespace adit {

/// The first eight bytes of a message, which identify its type. Requires at least eight bytes.
inline std::int64_t fingerprint(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes.first<8>()) value = value << 8 | byte;
  return static_cast<std::int64_t>(value);
}

/// Decodes a message of the generated type Msg from arbitrary bytes; never throws and never reads
/// beyond them. Rejects everything that `encode` cannot produce: another fingerprint, counts that
/// do not fit the bytes present, too few or too many bytes. A seal behind the message, as in the
/// log of a robot with sealed orders, is passed over; only the bus of a receiver verifies it.
template <class Msg>
Result<Msg> decode(std::span<const std::uint8_t> received) {
  const std::span<const std::uint8_t> bytes = without_seal(received);
  if (bytes.size() > INT_MAX) return Rejected{"too large"};
  if (bytes.size() < sizeof(std::int64_t)) return Rejected{"shorter than a fingerprint"};
  if (fingerprint(bytes) != Msg::getHash()) return Rejected{"fingerprint of another type"};
  Msg message;
  const int size = static_cast<int>(bytes.size());
  try {
    const int used = message.decode(bytes.data(), 0, size);
    if (used < 0) return Rejected{"truncated, or invalid count"};
    if (used != size) return Rejected{"trailing bytes"};
  } catch (const std::exception&) {
    return Rejected{"out of memory"};
  }
  return message;
}

/// Encodes a message. Its counts must match the lengths of its arrays.
template <class Msg>
std::vector<std::uint8_t> encode(const Msg& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int used = message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  if (used < 0) throw std::logic_error("a message exceeds its own encoded size");
  bytes.resize(static_cast<std::size_t>(used));  // a string ends at its first NUL
  return bytes;
}

}  // namespace adit
