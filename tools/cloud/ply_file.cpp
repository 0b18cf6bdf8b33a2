// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "tools/cloud/cloud_file.hpp"
#include "tools/cloud/ply_format.hpp"

namespace adit {
namespace {

using Element = PlyHeader::Element;

PlyIndices indices_in(const Element& vertex) {
  PlyIndices indices{};
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto index = vertex.scalar(kNames[i]);
    if (!index) throw std::runtime_error(fmt::format("vertices without property {}", kNames[i]));
    indices[i] = *index;
  }
  return indices;
}

template <class Rows>
PointCloud read_rows(const PlyHeader& header, Rows rows) {
  PointCloud cloud;
  for (const Element& element : header.elements) {
    rows.require_size(element);
    const bool is_vertex = element.name == "vertex";
    PlyIndices indices{kNoPlyIndex, kNoPlyIndex, kNoPlyIndex};
    if (is_vertex) {
      indices = indices_in(element);
      cloud.reserve(element.count);
    }
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      const Eigen::Vector3d p = rows.row(element, indices);
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

namespace {

void append(std::string& text, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) text += static_cast<char>(bits >> shift & 0xffU);
}

}  // namespace

void write_ply(const Cloud& cloud, const std::filesystem::path& file) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
      "y\n"
      "property float z\nend_header\n",
      cloud.points());
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      for (const float value : p) append(text, value);
    }
  }
  write_text_file(text, file);
}

}  // namespace adit
