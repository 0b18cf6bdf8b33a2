// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/pcd_reader.hpp"

#include <stdexcept>
#include <string>

#include "common/config/parse_number.hpp"
#include "tools/cloud/lzf.hpp"
#include "tools/cloud/pcd_header.hpp"

namespace adit {
namespace {

constexpr NumberType kUint32{NumberType::Kind::kUnsigned, 4};

[[noreturn]] void fail_short(const PcdHeader& header, std::size_t offset) {
  throw std::runtime_error("byte " + std::to_string(offset) + ": the file ends before the " +
                           std::to_string(header.points) + " points that it announces");
}

void read_ascii(const PcdHeader& header, TextLines& lines, PointCloud& cloud) {
  if (header.points > (lines.rest().size() + 1) / 6) fail_short(header, lines.offset());
  cloud.expect(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const auto line = lines.next_filled();
    if (!line) lines.fail("the file ends before the points that it announces");
    std::string_view words = *line;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t field = 0; field < header.fields.size(); ++field) {
      for (std::size_t k = 0; k < header.fields[field].count; ++k) {
        const std::string_view word = take_word(words);
        if (word.empty()) lines.fail("fewer numbers than fields");
        for (int axis = 0; axis < 3; ++axis) {
          if (header.xyz[static_cast<std::size_t>(axis)] != field) continue;
          const auto value = parse_number<double>(word);
          if (!value) lines.fail("a coordinate that is no number");
          p[axis] = *value;
        }
      }
    }
    cloud.add(p);
  }
}

/// Where the x, y or z of point 0 is, and how far on that of the next.
struct Column {
  NumberType type;
  std::size_t first = 0;
  std::size_t step = 0;
};

void read_columns(const std::array<Column, 3>& columns, const PcdHeader& header,
                  const std::uint8_t* bytes, PointCloud& cloud) {
  cloud.expect(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const Column& column = columns[static_cast<std::size_t>(axis)];
      p[axis] = column.type.read(bytes + column.first + i * column.step, false);
    }
    cloud.add(p);
  }
}

void read_binary(const PcdHeader& header, const TextLines& lines, PointCloud& cloud) {
  const std::size_t stride = header.stride();
  if (header.points > lines.rest().size() / stride) fail_short(header, lines.offset());
  std::array<Column, 3> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    columns[i] = {header.fields[header.xyz[i]].type, header.offset(header.xyz[i]), stride};
  }
  read_columns(columns, header, lines.rest().data(), cloud);
}

/// Field by field, all points in each.
void read_compressed(const PcdHeader& header, const TextLines& lines, PointCloud& cloud) {
  const auto rest = lines.rest();
  if (rest.size() < 8) fail_short(header, lines.offset());
  const auto packed = static_cast<std::size_t>(kUint32.read(rest.data(), false));
  const auto size = static_cast<std::size_t>(kUint32.read(rest.data() + 4, false));
  if (packed > rest.size() - 8) fail_short(header, lines.offset());
  const std::size_t stride = header.stride();
  if (size % stride != 0 || size / stride != header.points) {
    throw std::runtime_error("byte " + std::to_string(lines.offset()) +
                             ": the compressed data are not as long as the points");
  }
  const auto bytes = unpack_lzf(rest.subspan(8, packed), size);
  if (!bytes) {
    throw std::runtime_error("byte " + std::to_string(lines.offset()) +
                             ": the compressed data are damaged");
  }
  std::array<Column, 3> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const NumberType type = header.fields[header.xyz[i]].type;
    columns[i] = {type, header.offset(header.xyz[i]) * header.points, type.bytes};
  }
  read_columns(columns, header, bytes->data(), cloud);
}

}  // namespace

PointCloud read_pcd(std::span<const std::uint8_t> bytes) {
  TextLines lines(bytes);
  const PcdHeader header = read_pcd_header(lines);
  PointCloud cloud;
  cloud.sensor = header.viewpoint;
  switch (header.data) {
    case PcdHeader::Data::kAscii:
      read_ascii(header, lines, cloud);
      break;
    case PcdHeader::Data::kBinary:
      read_binary(header, lines, cloud);
      break;
    case PcdHeader::Data::kCompressed:
      read_compressed(header, lines, cloud);
      break;
  }
  return cloud;
}

}  // namespace adit
