// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <lzf.h>

#include "common/config/number_text.hpp"
#include "tools/cloud/cloud_file.hpp"
#include "tools/cloud/number_type.hpp"
#include "tools/cloud/text_lines.hpp"

namespace adit {
namespace {

/// Header of a PCD file, version 0.7 of the Point Cloud Library.
struct PcdHeader {
  enum class Data : std::uint8_t { kAscii, kBinary, kCompressed };

  struct Field {
    std::string name;
    NumberType type;
    std::size_t count = 1;
  };

  std::vector<Field> fields;
  std::array<std::size_t, 3> xyz{};  ///< indices of x, y and z among the fields
  std::uint64_t points = 0;
  Data data = Data::kAscii;
  std::optional<Eigen::Vector3d> viewpoint;

  /// Size of one point in a binary file.
  [[nodiscard]] std::size_t stride() const;
  /// Offset of a field in a point.
  [[nodiscard]] std::size_t offset(std::size_t field) const;
};

constexpr std::size_t kFieldsMax = 1000;
constexpr std::size_t kCountMax = 100'000;  // numbers per field, as of a histogram

/// Tokens of a header line.
using Tokens = std::vector<std::string_view>;

Tokens tokens_of(std::string_view line) {
  Tokens tokens;
  for (auto token = take_token(line); !token.empty(); token = take_token(line))
    tokens.push_back(token);
  return tokens;
}

/// Collects the header lines; finish() validates and combines them.
class PcdHeaderLines {
 public:
  explicit PcdHeaderLines(const TextLines& lines) : lines_(lines) {}

  void parse(std::string_view key, const Tokens& tokens) {
    if (key == "VERSION") return;
    if (key == "FIELDS" || key == "COLUMNS") return void(fields_ = tokens);
    if (key == "SIZE") return void(sizes_ = numbers(tokens));
    if (key == "TYPE") return void(types_ = tokens);
    if (key == "COUNT") return void(counts_ = numbers(tokens));
    if (key == "WIDTH") return void(width_ = number(tokens));
    if (key == "HEIGHT") return void(height_ = number(tokens));
    if (key == "POINTS") return void(points_ = number(tokens));
    if (key == "VIEWPOINT") return parse_viewpoint(tokens);
    lines_.fail("unknown keyword in the PCD header");
  }

  [[nodiscard]] PcdHeader finish(const Tokens& data) const {
    PcdHeader header;
    header.data = data_of(data);
    header.fields = fields();
    header.viewpoint = viewpoint_;
    header.points = points();
    constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) header.xyz[i] = index_of(kNames[i], header.fields);
    return header;
  }

 private:
  [[nodiscard]] std::uint64_t number(const Tokens& tokens) const {
    const auto value = tokens.size() == 1 ? parse_number<std::uint64_t>(tokens[0]) : std::nullopt;
    if (!value) lines_.fail("expected one integer");
    return *value;
  }

  [[nodiscard]] std::vector<std::uint64_t> numbers(const Tokens& tokens) const {
    std::vector<std::uint64_t> values;
    values.reserve(tokens.size());
    for (const std::string_view token : tokens) values.push_back(number({token}));
    return values;
  }

  void parse_viewpoint(const Tokens& tokens) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto value = tokens.size() == 7 ? parse_number<double>(tokens[at]) : std::nullopt;
      if (!value) lines_.fail("VIEWPOINT must have seven numbers");
      p[i] = *value;
    }
    if (!p.allFinite()) lines_.fail("VIEWPOINT is not finite");
    viewpoint_ = p;
  }

  [[nodiscard]] PcdHeader::Data data_of(const Tokens& tokens) const {
    if (tokens == Tokens{"ascii"}) return PcdHeader::Data::kAscii;
    if (tokens == Tokens{"binary"}) return PcdHeader::Data::kBinary;
    if (tokens == Tokens{"binary_compressed"}) return PcdHeader::Data::kCompressed;
    lines_.fail("DATA must be ascii, binary or binary_compressed");
  }

  [[nodiscard]] std::vector<PcdHeader::Field> fields() const {
    const bool consistent = fields_.size() == sizes_.size() && fields_.size() == types_.size() &&
                            (counts_.empty() || counts_.size() == fields_.size());
    if (!consistent || fields_.size() > kFieldsMax)
      lines_.fail("FIELDS, SIZE, TYPE and COUNT are inconsistent");
    std::vector<PcdHeader::Field> fields;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const auto type = pcd_type(types_[i], sizes_[i]);
      const std::uint64_t count = counts_.empty() ? 1 : counts_[i];
      if (!type || count > kCountMax) lines_.fail("field with an unknown PCD type");
      fields.push_back({std::string(fields_[i]), *type, count});
    }
    return fields;
  }

  [[nodiscard]] std::uint64_t points() const {
    if (!points_ && !(width_ && height_)) lines_.fail("POINTS, or WIDTH and HEIGHT, missing");
    if (points_ && !(width_ && height_)) return *points_;
    if (*height_ > 0 && *width_ > UINT64_MAX / *height_)
      lines_.fail("WIDTH times HEIGHT overflows");
    const std::uint64_t product = *width_ * *height_;
    if (points_ && *points_ != product) lines_.fail("POINTS is not WIDTH times HEIGHT");
    return product;
  }

  [[nodiscard]] std::size_t index_of(std::string_view name,
                                     const std::vector<PcdHeader::Field>& fields) const {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) {
      return field.name == name && field.count == 1;
    });
    if (found == fields.end()) lines_.fail(fmt::format("field {} missing", name));
    return static_cast<std::size_t>(found - fields.begin());
  }

  const TextLines& lines_;
  Tokens fields_;
  Tokens types_;
  std::vector<std::uint64_t> sizes_;
  std::vector<std::uint64_t> counts_;
  std::optional<std::uint64_t> width_;
  std::optional<std::uint64_t> height_;
  std::optional<std::uint64_t> points_;
  std::optional<Eigen::Vector3d> viewpoint_;
};

std::size_t PcdHeader::offset(std::size_t field) const {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < field; ++i) bytes += fields[i].type.bytes * fields[i].count;
  return bytes;
}

std::size_t PcdHeader::stride() const { return offset(fields.size()); }

/// Throws std::runtime_error with the line if the header is malformed.
PcdHeader read_pcd_header(TextLines& lines) {
  PcdHeaderLines header(lines);
  while (const auto line = lines.next_nonblank()) {
    if (line->starts_with('#')) continue;
    std::string_view tokens = *line;
    const std::string_view key = take_token(tokens);
    if (key == "DATA") return header.finish(tokens_of(tokens));
    header.parse(key, tokens_of(tokens));
  }
  lines.fail("header without DATA");
}

constexpr NumberType kUint32{NumberType::Kind::kUnsigned, 4};

[[noreturn]] void throw_truncated(const PcdHeader& header, std::size_t offset) {
  throw std::runtime_error(
      fmt::format("byte {}: file truncated: header announces {} points", offset, header.points));
}

void read_ascii(const PcdHeader& header, TextLines& lines, PointCloud& cloud) {
  if (header.points > (lines.rest().size() + 1) / 6) throw_truncated(header, lines.offset());
  cloud.reserve(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const auto line = lines.next_nonblank();
    if (!line) lines.fail("file truncated: fewer points than the header announces");
    std::string_view tokens = *line;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t field = 0; field < header.fields.size(); ++field) {
      for (std::size_t k = 0; k < header.fields[field].count; ++k) {
        const std::string_view token = take_token(tokens);
        if (token.empty()) lines.fail("fewer numbers than fields");
        for (int axis = 0; axis < 3; ++axis) {
          if (header.xyz[static_cast<std::size_t>(axis)] != field) continue;
          const auto value = parse_number<double>(token);
          if (!value) lines.fail("malformed coordinate");
          p[axis] = *value;
        }
      }
    }
    cloud.add(p);
  }
}

/// Layout of x, y or z: offset of the first point, and step to the next [bytes].
struct Column {
  NumberType type;
  std::size_t first = 0;
  std::size_t step = 0;
};

void read_columns(const std::array<Column, 3>& columns, const PcdHeader& header,
                  const std::uint8_t* bytes, PointCloud& cloud) {
  cloud.reserve(header.points);
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
  if (header.points > lines.rest().size() / stride) throw_truncated(header, lines.offset());
  std::array<Column, 3> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    columns[i] = {header.fields[header.xyz[i]].type, header.offset(header.xyz[i]), stride};
  }
  read_columns(columns, header, lines.rest().data(), cloud);
}

/// Decompresses LZF data into exactly `size` bytes; nothing if they are damaged. Memory is
/// allocated only if the compressed data can hold that many bytes.
std::optional<std::vector<std::uint8_t>> decompress(std::span<const std::uint8_t> packed,
                                                    std::size_t size) {
  constexpr std::size_t kBytesMaxPerPackedByte = 264 / 3 + 1;  // three bytes repeat at most 264
  if (packed.empty() != (size == 0)) return std::nullopt;  // lzf_decompress reads at least one byte
  if (size / kBytesMaxPerPackedByte > packed.size()) return std::nullopt;
  std::vector<std::uint8_t> bytes(size);
  if (size == 0) return bytes;
  const unsigned written = lzf_decompress(packed.data(), static_cast<unsigned>(packed.size()),
                                          bytes.data(), static_cast<unsigned>(size));
  if (written != size) return std::nullopt;
  return bytes;
}

/// The data are ordered by field, each with all points.
void read_compressed(const PcdHeader& header, const TextLines& lines, PointCloud& cloud) {
  const auto rest = lines.rest();
  if (rest.size() < 8) throw_truncated(header, lines.offset());
  const auto packed = static_cast<std::size_t>(kUint32.read(rest.data(), false));
  const auto size = static_cast<std::size_t>(kUint32.read(rest.data() + 4, false));
  if (packed > rest.size() - 8) throw_truncated(header, lines.offset());
  const std::size_t stride = header.stride();
  if (size % stride != 0 || size / stride != header.points) {
    throw std::runtime_error(
        fmt::format("byte {}: size of the compressed data does not match POINTS", lines.offset()));
  }
  const auto bytes = decompress(rest.subspan(8, packed), size);
  if (!bytes) {
    throw std::runtime_error(fmt::format("byte {}: compressed data are damaged", lines.offset()));
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
