// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include <Eigen/Core>

#include "tools/cloud/ply_header.hpp"

namespace adit {

/// Of x, y and z among the properties of an element.
using PlyPlaces = std::array<std::size_t, 3>;
inline constexpr std::size_t kNoPlyPlace = std::numeric_limits<std::size_t>::max();

/// The elements of a binary PLY file one after the other. Throws std::runtime_error, with the byte,
/// where the file ends before them.
class PlyBinaryRows {
 public:
  PlyBinaryRows(const TextLines& lines, bool big_endian)
      : left_(lines.rest()), offset_(lines.offset()), big_endian_(big_endian) {}

  /// Whether the file can hold as many as are announced.
  void require(const PlyHeader::Element& element) const;
  /// The next one: what it has at the places, 0 where there is no place.
  Eigen::Vector3d row(const PlyHeader::Element& element, const PlyPlaces& places);

 private:
  void skip_list(const PlyHeader::Element& element, const PlyHeader::Property& property);
  const std::uint8_t* take(std::size_t bytes, const PlyHeader::Element& element);
  [[noreturn]] void fail_short(const PlyHeader::Element& element) const;

  std::span<const std::uint8_t> left_;
  std::size_t offset_;
  bool big_endian_;
};

/// The same of an ascii file, an element a line. Throws with the line.
class PlyAsciiRows {
 public:
  /// `lines` must outlive this.
  explicit PlyAsciiRows(TextLines& lines) : lines_(lines) {}

  void require(const PlyHeader::Element& element) const;
  Eigen::Vector3d row(const PlyHeader::Element& element, const PlyPlaces& places);

 private:
  [[nodiscard]] double number(std::string_view& words) const;
  void skip_list(std::string_view& words, double count) const;

  TextLines& lines_;
};

}  // namespace adit
