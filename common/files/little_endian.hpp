// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace adit {

/// Appends the lowest `size` bytes of a number, the lowest first.
inline void append_little_endian(std::string& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    bytes.push_back(static_cast<char>((value >> (8U * i)) & 0xFFU));
}

/// Appends an integer with all its bytes.
template <class T>
void append_little_endian(std::string& bytes, T value) {
  append_little_endian(bytes, static_cast<std::uint64_t>(value), sizeof(T));
}

}  // namespace adit
