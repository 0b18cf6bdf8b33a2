// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>

namespace adit {

/// A value for a record, as it lies in memory: it has no gaps, so that all bytes mean something.
/// The same bits on machines of one byte order.
template <class T>
std::array<std::uint8_t, sizeof(T)> bytes_of(const T& value) {
  return std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
}

/// Nothing where these are not as many bytes as it has.
template <class T>
std::optional<T> value_from(std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, sizeof(T)> read{};
  if (bytes.size() != read.size()) return std::nullopt;
  std::ranges::copy(bytes, read.begin());
  return std::bit_cast<T>(read);
}

}  // namespace adit
