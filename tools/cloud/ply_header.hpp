// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace adit
