// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/pcd_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/number_text.hpp"
#include "tools/cloud/lzf.hpp"
#include "tools/cloud/number_type.hpp"
#include "tools/cloud/text_lines.hpp"

namespace adit {
namespace {

/// What the head of a PCD file (version 0.7 of the Point Cloud Library) announces.
struct PcdHeader {
  enum class Data : std::uint8_t { kAscii, kBinary, kCompressed };

  struct Field {
    std::string name;
    NumberType type;
    std::size_t count = 1;
  };

  std::vector<Field> fields;
  std::array<std::size_t, 3> xyz{};  ///< their places among the fields
  std::uint64_t points = 0;
  Data data = Data::kAscii;
  std::optional<Eigen::Vector3d> viewpoint;

  /// Of one point, in a binary file.
  [[nodiscard]] std::size_t stride() const;
  /// Bytes before a field in a point.
  [[nodiscard]] std::size_t offset(std::size_t field) const;
};

/// Takes the head off the lines. Throws std::runtime_error, with the line, where it is none.
PcdHeader read_pcd_header(TextLines& lines);

constexpr std::size_t kFieldsMax = 1000;
constexpr std::size_t kCountMax = 100'000;  // numbers in one field, a histogram

/// The words of a line of the header.
using Tokens = std::vector<std::string_view>;

Tokens tokens_of(std::string_view line) {
  Tokens tokens;
  for (auto token = take_token(line); !token.empty(); token = take_token(line))
    tokens.push_back(token);
  return tokens;
}

/// The lines as they come; what they say together is put together at the end.
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
    lines_.fail("what a PCD header does not have");
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
    if (!value) lines_.fail("one whole number is expected");
    return *value;
  }

  [[nodiscard]] std::vector<std::uint64_t> numbers(const Tokens& tokens) const {
    std::vector<std::uint64_t> values;
    values.reserve(tokens.size());
    for (const std::string_view token : tokens) values.push_back(number({token}));
    return values;
  }

  void parse_viewpoint(const Tokens& tokens) {
    Eigen::Vector3d index = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto value = tokens.size() == 7 ? parse_number<double>(tokens[at]) : std::nullopt;
      if (!value) lines_.fail("VIEWPOINT takes seven numbers");
      index[i] = *value;
    }
    if (!index.allFinite()) lines_.fail("a VIEWPOINT that is not finite");
    viewpoint_ = index;
  }

  [[nodiscard]] PcdHeader::Data data_of(const Tokens& tokens) const {
    if (tokens == Tokens{"ascii"}) return PcdHeader::Data::kAscii;
    if (tokens == Tokens{"binary"}) return PcdHeader::Data::kBinary;
    if (tokens == Tokens{"binary_compressed"}) return PcdHeader::Data::kCompressed;
    lines_.fail("DATA is none of ascii, binary, binary_compressed");
  }

  [[nodiscard]] std::vector<PcdHeader::Field> fields() const {
    const bool agree = fields_.size() == sizes_.size() && fields_.size() == types_.size() &&
                       (counts_.empty() || counts_.size() == fields_.size());
    if (!agree || fields_.size() > kFieldsMax)
      lines_.fail("FIELDS, SIZE, TYPE, COUNT do not agree");
    std::vector<PcdHeader::Field> fields;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const auto type = pcd_type(types_[i], sizes_[i]);
      const std::uint64_t count = counts_.empty() ? 1 : counts_[i];
      if (!type || count > kCountMax) lines_.fail("a field of a type that PCD does not have");
      fields.push_back({std::string(fields_[i]), *type, count});
    }
    return fields;
  }

  [[nodiscard]] std::uint64_t points() const {
    if (!points_ && !(width_ && height_)) lines_.fail("neither POINTS nor WIDTH and HEIGHT");
    if (points_ && !(width_ && height_)) return *points_;
    if (*height_ > 0 && *width_ > UINT64_MAX / *height_)
      lines_.fail("WIDTH times HEIGHT is absurd");
    const std::uint64_t product = *width_ * *height_;
    if (points_ && *points_ != product) lines_.fail("POINTS is not WIDTH times HEIGHT");
    return product;
  }

  [[nodiscard]] std::size_t index_of(std::string_view name,
                                     const std::vector<PcdHeader::Field>& fields) const {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) {
      return field.name == name && field.count == 1;
    });
    if (found == fields.end()) lines_.fail("no field " + std::string(name));
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

PcdHeader read_pcd_header(TextLines& lines) {
  PcdHeaderLines header(lines);
  while (const auto line = lines.next_nonblank()) {
    if (line->starts_with('#')) continue;
    std::string_view tokens = *line;
    const std::string_view key = take_token(tokens);
    if (key == "DATA") return header.finish(tokens_of(tokens));
    header.parse(key, tokens_of(tokens));
  }
  lines.fail("the header has no end");
}

constexpr NumberType kUint32{NumberType::Kind::kUnsigned, 4};

[[noreturn]] void throw_truncated(const PcdHeader& header, std::size_t offset) {
  throw std::runtime_error("byte " + std::to_string(offset) + ": the file ends before the " +
                           std::to_string(header.points) + " points that it announces");
}

void read_ascii(const PcdHeader& header, TextLines& lines, PointCloud& cloud) {
  if (header.points > (lines.rest().size() + 1) / 6) throw_truncated(header, lines.offset());
  cloud.reserve(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const auto line = lines.next_nonblank();
    if (!line) lines.fail("the file ends before the points that it announces");
    std::string_view tokens = *line;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t field = 0; field < header.fields.size(); ++field) {
      for (std::size_t k = 0; k < header.fields[field].count; ++k) {
        const std::string_view token = take_token(tokens);
        if (token.empty()) lines.fail("fewer numbers than fields");
        for (int axis = 0; axis < 3; ++axis) {
          if (header.xyz[static_cast<std::size_t>(axis)] != field) continue;
          const auto value = parse_number<double>(token);
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

/// Field by field, all points in each.
void read_compressed(const PcdHeader& header, const TextLines& lines, PointCloud& cloud) {
  const auto rest = lines.rest();
  if (rest.size() < 8) throw_truncated(header, lines.offset());
  const auto packed = static_cast<std::size_t>(kUint32.read(rest.data(), false));
  const auto size = static_cast<std::size_t>(kUint32.read(rest.data() + 4, false));
  if (packed > rest.size() - 8) throw_truncated(header, lines.offset());
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
