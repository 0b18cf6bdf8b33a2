// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/ply_format.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Format = PlyHeader::Format;

constexpr std::size_t kNameMax = 100;

Format format_of(std::string_view tokens, const TextLines& lines) {
  const std::string_view name = take_token(tokens);
  if (take_token(tokens) != "1.0") lines.fail("unsupported PLY version, expected 1.0");
  if (name == "ascii") return Format::kAscii;
  if (name == "binary_little_endian") return Format::kLittleEndian;
  if (name == "binary_big_endian") return Format::kBigEndian;
  lines.fail("unknown PLY format");
}

PlyHeader::Element element_of(std::string_view tokens, const TextLines& lines) {
  const std::string name(take_token(tokens));
  const auto count = parse_number<std::uint64_t>(take_token(tokens));
  if (!count) lines.fail("'element' without a count");
  const bool printable = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isgraph(c) != 0;  // error messages print it
  });
  if (!printable || name.size() > kNameMax) lines.fail("'element' without a valid name");
  return {name, *count, {}};
}

NumberType type_of(std::string_view& tokens, const TextLines& lines) {
  const auto type = ply_type(take_token(tokens));
  if (!type) lines.fail("unknown PLY type");
  return *type;
}

PlyHeader::Property property_of(std::string_view tokens, const TextLines& lines) {
  PlyHeader::Property property;
  std::string_view rest = tokens;
  if (take_token(rest) == "list") {
    property.count = type_of(rest, lines);
    if (property.count->kind == NumberType::Kind::kFloat)
      lines.fail("list with a floating-point length");
    tokens = rest;
  }
  property.type = type_of(tokens, lines);
  property.name = take_token(tokens);
  if (property.name.empty()) lines.fail("property without a name");
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
  if (lines.next() != "ply") throw std::runtime_error("line 1: expected 'ply'");
  PlyHeader header;
  bool has_format = false;
  while (const auto line = lines.next()) {
    std::string_view tokens = *line;
    const std::string_view key = take_token(tokens);
    if (key == "end_header") {
      if (!has_format) lines.fail("header without 'format'");
      return header;
    }
    if (key == "format") {
      header.format = format_of(tokens, lines);
      has_format = true;
    } else if (key == "element") {
      header.elements.push_back(element_of(tokens, lines));
    } else if (key == "property") {
      if (header.elements.empty()) lines.fail("'property' before the first 'element'");
      header.elements.back().properties.push_back(property_of(tokens, lines));
    } else if (!key.empty() && key != "comment" && key != "obj_info") {
      lines.fail("unknown keyword in the PLY header");
    }
  }
  lines.fail("header without 'end_header'");
}

namespace {

using Element = PlyHeader::Element;

std::string truncated(const Element& element) {
  return fmt::format("file truncated: header announces {} of {}", element.count,
                     quote(element.name));
}

}  // namespace

void PlyAsciiRows::require_size(const Element& element) const {
  // Each element takes at least a digit and the end of the line.
  if (element.properties.empty() || element.count <= (lines_.rest().size() + 1) / 2) return;
  lines_.fail(truncated(element));
}

Eigen::Vector3d PlyAsciiRows::row(const Element& element, const PlyIndices& indices) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  if (element.properties.empty()) return p;
  const auto line = lines_.next_nonblank();
  if (!line) lines_.fail(truncated(element));
  std::string_view tokens = *line;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const double value = number(tokens);
    if (element.properties[i].count) skip_list(tokens, value);
    for (int axis = 0; axis < 3; ++axis) {
      if (indices[static_cast<std::size_t>(axis)] == i) p[axis] = value;
    }
  }
  return p;
}

double PlyAsciiRows::number(std::string_view& tokens) const {
  const auto value = parse_number<double>(take_token(tokens));
  if (!value) lines_.fail("missing or malformed number");
  return *value;
}

void PlyAsciiRows::skip_list(std::string_view& tokens, double count) const {
  if (!(count >= 0.0 && count <= static_cast<double>(tokens.size()))) {
    lines_.fail("list longer than its line");
  }
  for (auto i = static_cast<std::size_t>(count); i > 0; --i) (void)number(tokens);
}

void PlyBinaryRows::require_size(const Element& element) const {
  const std::size_t each = element.bytes_min();
  if (each > 0 && element.count > rest_.size() / each) throw_truncated(element);
}

Eigen::Vector3d PlyBinaryRows::row(const Element& element, const PlyIndices& indices) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyHeader::Property& property = element.properties[i];
    if (property.count) {
      skip_list(element, property);
      continue;
    }
    const std::uint8_t* const at = read_bytes(property.type.bytes, element);
    for (int axis = 0; axis < 3; ++axis) {
      if (indices[static_cast<std::size_t>(axis)] == i) {
        p[axis] = property.type.read(at, big_endian_);
      }
    }
  }
  return p;
}

void PlyBinaryRows::skip_list(const Element& element, const PlyHeader::Property& property) {
  const double count =
      property.count->read(read_bytes(property.count->bytes, element), big_endian_);
  const std::size_t fit = rest_.size() / property.type.bytes;
  if (!(count >= 0.0 && count <= static_cast<double>(fit))) throw_truncated(element);
  read_bytes(static_cast<std::size_t>(count) * property.type.bytes, element);
}

const std::uint8_t* PlyBinaryRows::read_bytes(std::size_t bytes, const Element& element) {
  if (bytes > rest_.size()) throw_truncated(element);
  const std::uint8_t* const at = rest_.data();
  rest_ = rest_.subspan(bytes);
  offset_ += bytes;
  return at;
}

void PlyBinaryRows::throw_truncated(const Element& element) const {
  throw std::runtime_error(fmt::format("byte {}: {}", offset_, truncated(element)));
}

}  // namespace adit
