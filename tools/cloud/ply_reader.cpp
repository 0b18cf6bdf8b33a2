// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/ply_reader.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "tools/cloud/ply_header.hpp"
#include "tools/cloud/ply_rows.hpp"

namespace adit {
namespace {

using Element = PlyHeader::Element;

PlyPlaces places_in(const Element& vertex) {
  PlyPlaces places{};
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto place = vertex.scalar(kNames[i]);
    if (!place) throw std::runtime_error(std::string("the vertices have no ") + kNames[i]);
    places[i] = *place;
  }
  return places;
}

template <class Rows>
PointCloud read_rows(const PlyHeader& header, Rows rows) {
  PointCloud cloud;
  for (const Element& element : header.elements) {
    rows.require(element);
    const bool is_vertex = element.name == "vertex";
    PlyPlaces places{kNoPlyPlace, kNoPlyPlace, kNoPlyPlace};
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
  if (header.format == PlyHeader::Format::kAscii) return read_rows(header, PlyAsciiRows(lines));
  return read_rows(header, PlyBinaryRows(lines, header.format == PlyHeader::Format::kBigEndian));
}

}  // namespace adit
