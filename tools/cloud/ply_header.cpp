// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/ply_header.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "common/config/parse_number.hpp"

namespace adit {
namespace {

using Format = PlyHeader::Format;

constexpr std::size_t kNameMax = 100;

Format format_of(std::string_view words, const TextLines& lines) {
  const std::string_view name = take_word(words);
  if (take_word(words) != "1.0") lines.fail("a version of PLY other than 1.0");
  if (name == "ascii") return Format::kAscii;
  if (name == "binary_little_endian") return Format::kLittleEndian;
  if (name == "binary_big_endian") return Format::kBigEndian;
  lines.fail("a format that PLY does not have");
}

PlyHeader::Element element_of(std::string_view words, const TextLines& lines) {
  const std::string name(take_word(words));
  const auto count = parse_number<std::uint64_t>(take_word(words));
  if (!count) lines.fail("'element' without a number of them");
  const bool printable = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isgraph(c) != 0;  // it is shown where something is wrong
  });
  if (!printable || name.size() > kNameMax) lines.fail("'element' without a usable name");
  return {name, *count, {}};
}

NumberType type_of(std::string_view& words, const TextLines& lines) {
  const auto type = ply_type(take_word(words));
  if (!type) lines.fail("a type that PLY does not have");
  return *type;
}

PlyHeader::Property property_of(std::string_view words, const TextLines& lines) {
  PlyHeader::Property property;
  std::string_view rest = words;
  if (take_word(rest) == "list") {
    property.count = type_of(rest, lines);
    if (property.count->kind == NumberType::Kind::kFloat) lines.fail("a list counted in fractions");
    words = rest;
  }
  property.type = type_of(words, lines);
  property.name = take_word(words);
  if (property.name.empty()) lines.fail("a property without a name");
  return property;
}

}  // namespace

std::size_t PlyHeader::Element::bytes_min() const {
  std::size_t bytes = 0;
  for (const Property& property : properties) {
    bytes += property.count ? property.count->bytes : property.type.bytes;
  }
  return bytes;
}

std::optional<std::size_t> PlyHeader::Element::scalar(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property && !properties[i].count) return i;
  }
  return std::nullopt;
}

PlyHeader read_ply_header(TextLines& lines) {
  if (lines.next() != "ply") throw std::runtime_error("line 1: it does not begin with 'ply'");
  PlyHeader header;
  bool has_format = false;
  while (const auto line = lines.next()) {
    std::string_view words = *line;
    const std::string_view key = take_word(words);
    if (key == "end_header") {
      if (!has_format) lines.fail("the header ends without a 'format'");
      return header;
    }
    if (key == "format") {
      header.format = format_of(words, lines);
      has_format = true;
    } else if (key == "element") {
      header.elements.push_back(element_of(words, lines));
    } else if (key == "property") {
      if (header.elements.empty()) lines.fail("'property' before the first 'element'");
      header.elements.back().properties.push_back(property_of(words, lines));
    } else if (!key.empty() && key != "comment" && key != "obj_info") {
      lines.fail("what a PLY header does not have");
    }
  }
  lines.fail("the header has no end");
}

}  // namespace adit
