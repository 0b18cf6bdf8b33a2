// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/cloud/number_type.hpp"
#include "tools/cloud/text_lines.hpp"

namespace adit {

/// What the head of a PLY file announces.
struct PlyHeader {
  enum class Format : std::uint8_t { kAscii, kLittleEndian, kBigEndian };

  struct Property {
    std::string name;
    NumberType type;                  ///< of a list, of what is in it
    std::optional<NumberType> count;  ///< of a list: of the number before it
  };

  struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;

    /// The least that one takes in a binary file.
    [[nodiscard]] std::size_t bytes_min() const;
    /// The place of the scalar property among the others, or nothing.
    [[nodiscard]] std::optional<std::size_t> scalar(std::string_view property) const;
  };

  Format format = Format::kAscii;
  std::vector<Element> elements;
};

/// Takes the head off the lines. Throws std::runtime_error, with the line, where it is none.
PlyHeader read_ply_header(TextLines& lines);

/// Of x, y and z among the properties of an element.
using PlyIndices = std::array<std::size_t, 3>;
inline constexpr std::size_t kNoPlyIndex = std::numeric_limits<std::size_t>::max();

/// The elements of a binary PLY file one after the other. Throws std::runtime_error, with the byte,
/// where the file ends before them.
class PlyBinaryRows {
 public:
  PlyBinaryRows(const TextLines& lines, bool big_endian)
      : left_(lines.rest()), offset_(lines.offset()), big_endian_(big_endian) {}

  /// Whether the file can hold as many as are announced.
  void require_size(const PlyHeader::Element& element) const;
  /// The next one: what it has at the places, 0 where there is no place.
  Eigen::Vector3d row(const PlyHeader::Element& element, const PlyIndices& indices);

 private:
  void skip_list(const PlyHeader::Element& element, const PlyHeader::Property& property);
  const std::uint8_t* read_bytes(std::size_t bytes, const PlyHeader::Element& element);
  [[noreturn]] void throw_truncated(const PlyHeader::Element& element) const;

  std::span<const std::uint8_t> left_;
  std::size_t offset_;
  bool big_endian_;
};

/// The same of an ascii file, an element a line. Throws with the line.
class PlyAsciiRows {
 public:
  /// `lines` must outlive this.
  explicit PlyAsciiRows(TextLines& lines) : lines_(lines) {}

  void require_size(const PlyHeader::Element& element) const;
  Eigen::Vector3d row(const PlyHeader::Element& element, const PlyIndices& indices);

 private:
  [[nodiscard]] double number(std::string_view& tokens) const;
  void skip_list(std::string_view& tokens, double count) const;

  TextLines& lines_;
};

}  // namespace adit
