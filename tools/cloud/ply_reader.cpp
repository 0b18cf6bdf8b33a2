// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/ply_reader.hpp"

#include <array>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/config/parse_number.hpp"
#include "tools/cloud/ply_header.hpp"

namespace adit {
namespace {

using Element = PlyHeader::Element;
using Places = std::array<std::size_t, 3>;  // of x, y and z among the properties

constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

Places places_in(const Element& vertex) {
  Places places{};
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto place = vertex.scalar(kNames[i]);
    if (!place) throw std::runtime_error(std::string("the vertices have no ") + kNames[i]);
    places[i] = *place;
  }
  return places;
}

/// Elements one after the other, whatever they are laid down in. `row` takes the x, y and z of the
/// next one, at the places that it is given.
class BinaryRows {
 public:
  BinaryRows(const TextLines& lines, bool big_endian)
      : left_(lines.rest()), offset_(lines.offset()), big_endian_(big_endian) {}

  void require(const Element& element) const {
    const std::size_t each = element.bytes_min();
    if (each > 0 && element.count > left_.size() / each) fail_short(element);
  }

  Eigen::Vector3d row(const Element& element, const Places& places) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyHeader::Property& property = element.properties[i];
      if (property.count) {
        skip_list(element, property);
        continue;
      }
      const std::uint8_t* const at = take(property.type.bytes, element);
      for (int axis = 0; axis < 3; ++axis) {
        if (places[static_cast<std::size_t>(axis)] == i) {
          p[axis] = property.type.read(at, big_endian_);
        }
      }
    }
    return p;
  }

 private:
  void skip_list(const Element& element, const PlyHeader::Property& property) {
    const double count = property.count->read(take(property.count->bytes, element), big_endian_);
    const std::size_t fit = left_.size() / property.type.bytes;
    if (!(count >= 0.0 && count <= static_cast<double>(fit))) fail_short(element);
    take(static_cast<std::size_t>(count) * property.type.bytes, element);
  }

  const std::uint8_t* take(std::size_t bytes, const Element& element) {
    if (bytes > left_.size()) fail_short(element);
    const std::uint8_t* const at = left_.data();
    left_ = left_.subspan(bytes);
    offset_ += bytes;
    return at;
  }

  [[noreturn]] void fail_short(const Element& element) const {
    throw std::runtime_error("byte " + std::to_string(offset_) + ": the file ends before the " +
                             std::to_string(element.count) + " of '" + element.name +
                             "' that it announces");
  }

  std::span<const std::uint8_t> left_;
  std::size_t offset_;
  bool big_endian_;
};

class AsciiRows {
 public:
  explicit AsciiRows(TextLines& lines) : lines_(lines) {}

  void require(const Element& element) const {
    // A digit and the end of the line for each.
    if (element.properties.empty() || element.count <= (lines_.rest().size() + 1) / 2) return;
    lines_.fail("the file is too short for the " + std::to_string(element.count) + " of '" +
                element.name + "' that it announces");
  }

  Eigen::Vector3d row(const Element& element, const Places& places) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    if (element.properties.empty()) return p;
    const auto line = lines_.next_filled();
    if (!line) {
      lines_.fail("the file ends before the " + std::to_string(element.count) + " of '" +
                  element.name + "' that it announces");
    }
    std::string_view words = *line;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const double value = number(words);
      if (element.properties[i].count) skip_list(words, value);
      for (int axis = 0; axis < 3; ++axis) {
        if (places[static_cast<std::size_t>(axis)] == i) p[axis] = value;
      }
    }
    return p;
  }

 private:
  [[nodiscard]] double number(std::string_view& words) const {
    const auto value = parse_number<double>(take_word(words));
    if (!value) lines_.fail("a number is missing, or is none");
    return *value;
  }

  void skip_list(std::string_view& words, double count) const {
    if (!(count >= 0.0 && count <= static_cast<double>(words.size()))) {
      lines_.fail("a list that is longer than its line");
    }
    for (auto i = static_cast<std::size_t>(count); i > 0; --i) (void)number(words);
  }

  TextLines& lines_;
};

template <class Rows>
PointCloud read_rows(const PlyHeader& header, Rows rows) {
  PointCloud cloud;
  for (const Element& element : header.elements) {
    rows.require(element);
    const bool is_vertex = element.name == "vertex";
    Places places{kNowhere, kNowhere, kNowhere};
    if (is_vertex) {
      places = places_in(element);
      cloud.expect(element.count);
    }
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      const Eigen::Vector3d p = rows.row(element, places);
      if (is_vertex) cloud.add(p);
    }
    if (is_vertex) return cloud;
  }
  throw std::runtime_error("no 'element vertex' in the header");
}

}  // namespace

PointCloud read_ply(std::span<const std::uint8_t> bytes) {
  TextLines lines(bytes);
  const PlyHeader header = read_ply_header(lines);
  if (header.format == PlyHeader::Format::kAscii) return read_rows(header, AsciiRows(lines));
  return read_rows(header, BinaryRows(lines, header.format == PlyHeader::Format::kBigEndian));
}

}  // namespace adit
