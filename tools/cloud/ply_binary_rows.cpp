// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string>

#include "tools/cloud/ply_rows.hpp"

namespace adit {
namespace {

using Element = PlyHeader::Element;

}  // namespace

void PlyBinaryRows::require(const Element& element) const {
  const std::size_t each = element.bytes_min();
  if (each > 0 && element.count > left_.size() / each) fail_short(element);
}

Eigen::Vector3d PlyBinaryRows::row(const Element& element, const PlyPlaces& places) {
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

void PlyBinaryRows::skip_list(const Element& element, const PlyHeader::Property& property) {
  const double count = property.count->read(take(property.count->bytes, element), big_endian_);
  const std::size_t fit = left_.size() / property.type.bytes;
  if (!(count >= 0.0 && count <= static_cast<double>(fit))) fail_short(element);
  take(static_cast<std::size_t>(count) * property.type.bytes, element);
}

const std::uint8_t* PlyBinaryRows::take(std::size_t bytes, const Element& element) {
  if (bytes > left_.size()) fail_short(element);
  const std::uint8_t* const at = left_.data();
  left_ = left_.subspan(bytes);
  offset_ += bytes;
  return at;
}

void PlyBinaryRows::fail_short(const Element& element) const {
  throw std::runtime_error("byte " + std::to_string(offset_) + ": the file ends before the " +
                           std::to_string(element.count) + " of '" + element.name +
                           "' that it announces");
}

}  // namespace adit
