// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace adit {

/// How a number is laid down in a binary file.
struct NumberType {
  enum class Kind : std::uint8_t { kSigned, kUnsigned, kFloat };

  Kind kind = Kind::kFloat;
  std::size_t bytes = 4;  ///< 1, 2, 4 or 8; of floats 4 or 8

  /// Of `bytes` bytes; 8-byte integers lose what a double cannot hold.
  [[nodiscard]] double read(const std::uint8_t* at, bool big_endian) const;
};

/// By its name in PLY ("uchar", "float32", ..), or nothing.
std::optional<NumberType> ply_type(std::string_view name);
/// By its letter and size in PCD ("F", 4), or nothing.
std::optional<NumberType> pcd_type(std::string_view letter, std::size_t bytes);

}  // namespace adit
