// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace adit {

/// Binary encoding of a number in a file.
struct NumberType {
  enum class Kind : std::uint8_t { kSigned, kUnsigned, kFloat };

  Kind kind = Kind::kFloat;
  std::size_t bytes = 4;  ///< 1, 2, 4 or 8; floats 4 or 8

  /// Decodes a number of `bytes` bytes. Integers of 8 bytes are rounded to double precision.
  [[nodiscard]] double read(const std::uint8_t* at, bool big_endian) const;
};

/// Type of this name in PLY ("uchar", "float32", ..), if it exists.
std::optional<NumberType> ply_type(std::string_view name);
/// Type of this letter and size in PCD ("F", 4), if it exists.
std::optional<NumberType> pcd_type(std::string_view letter, std::size_t bytes);

}  // namespace adit
