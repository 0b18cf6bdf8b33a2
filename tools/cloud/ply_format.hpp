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

/// Header of a PLY file.
struct PlyHeader {
  enum class Format : std::uint8_t { kAscii, kLittleEndian, kBigEndian };

  struct Property {
    std::string name;
    NumberType type;                  ///< of a list: of its entries
    std::optional<NumberType> count;  ///< of a list: of its length
  };

  struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;

    /// Minimum size of one element in a binary file.
    [[nodiscard]] std::size_t bytes_min() const;
    /// Index of the scalar property of this name, if it exists.
    [[nodiscard]] std::optional<std::size_t> scalar(std::string_view property) const;
  };

  Format format = Format::kAscii;
  std::vector<Element> elements;
};

/// Reads the header. Throws std::runtime_error with the line if it is malformed.
PlyHeader read_ply_header(TextLines& lines);

/// Indices of x, y and z among the properties of an element.
using PlyIndices = std::array<std::size_t, 3>;
inline constexpr std::size_t kNoPlyIndex = std::numeric_limits<std::size_t>::max();

/// Reads the elements of a binary PLY file in order. Throws std::runtime_error with the byte offset
/// if the file is truncated.
class PlyBinaryRows {
 public:
  PlyBinaryRows(const TextLines& lines, bool big_endian)
      : rest_(lines.rest()), offset_(lines.offset()), big_endian_(big_endian) {}

  /// Throws if the file is too short for the number of elements in the header.
  void require_size(const PlyHeader::Element& element) const;
  /// Reads the next element and returns the properties at the indices; 0 for kNoPlyIndex.
  Eigen::Vector3d row(const PlyHeader::Element& element, const PlyIndices& indices);

 private:
  void skip_list(const PlyHeader::Element& element, const PlyHeader::Property& property);
  const std::uint8_t* read_bytes(std::size_t bytes, const PlyHeader::Element& element);
  [[noreturn]] void throw_truncated(const PlyHeader::Element& element) const;

  std::span<const std::uint8_t> rest_;
  std::size_t offset_;
  bool big_endian_;
};

/// The same for an ascii file, with one element per line. Throws with the line number.
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
