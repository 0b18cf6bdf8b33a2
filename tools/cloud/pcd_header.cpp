// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/pcd_header.hpp"

#include <algorithm>

#include "common/config/parse_number.hpp"

namespace adit {
namespace {

constexpr std::size_t kFieldsMax = 1000;
constexpr std::size_t kCountMax = 100'000;  // numbers in one field, a histogram

/// The words of a line of the header.
using Words = std::vector<std::string_view>;

Words words_of(std::string_view line) {
  Words words;
  for (auto word = take_word(line); !word.empty(); word = take_word(line)) words.push_back(word);
  return words;
}

/// The lines as they come; what they say together is put together at the end.
class PcdHeaderLines {
 public:
  explicit PcdHeaderLines(const TextLines& lines) : lines_(lines) {}

  void take(std::string_view key, const Words& words) {
    if (key == "VERSION") return;
    if (key == "FIELDS" || key == "COLUMNS") return void(fields_ = words);
    if (key == "SIZE") return void(sizes_ = numbers(words));
    if (key == "TYPE") return void(types_ = words);
    if (key == "COUNT") return void(counts_ = numbers(words));
    if (key == "WIDTH") return void(width_ = number(words));
    if (key == "HEIGHT") return void(height_ = number(words));
    if (key == "POINTS") return void(points_ = number(words));
    if (key == "VIEWPOINT") return take_viewpoint(words);
    lines_.fail("what a PCD header does not have");
  }

  [[nodiscard]] PcdHeader finish(const Words& data) const {
    PcdHeader header;
    header.data = data_of(data);
    header.fields = fields();
    header.viewpoint = viewpoint_;
    header.points = points();
    constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) header.xyz[i] = place_of(kNames[i], header.fields);
    return header;
  }

 private:
  [[nodiscard]] std::uint64_t number(const Words& words) const {
    const auto value = words.size() == 1 ? parse_number<std::uint64_t>(words[0]) : std::nullopt;
    if (!value) lines_.fail("one whole number is expected");
    return *value;
  }

  [[nodiscard]] std::vector<std::uint64_t> numbers(const Words& words) const {
    std::vector<std::uint64_t> values;
    values.reserve(words.size());
    for (const std::string_view word : words) values.push_back(number({word}));
    return values;
  }

  void take_viewpoint(const Words& words) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto value = words.size() == 7 ? parse_number<double>(words[at]) : std::nullopt;
      if (!value) lines_.fail("VIEWPOINT takes seven numbers");
      place[i] = *value;
    }
    if (!place.allFinite()) lines_.fail("a VIEWPOINT that is not finite");
    viewpoint_ = place;
  }

  [[nodiscard]] PcdHeader::Data data_of(const Words& words) const {
    if (words == Words{"ascii"}) return PcdHeader::Data::kAscii;
    if (words == Words{"binary"}) return PcdHeader::Data::kBinary;
    if (words == Words{"binary_compressed"}) return PcdHeader::Data::kCompressed;
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

  [[nodiscard]] std::size_t place_of(std::string_view name,
                                     const std::vector<PcdHeader::Field>& fields) const {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) {
      return field.name == name && field.count == 1;
    });
    if (found == fields.end()) lines_.fail("no field " + std::string(name));
    return static_cast<std::size_t>(found - fields.begin());
  }

  const TextLines& lines_;
  Words fields_;
  Words types_;
  std::vector<std::uint64_t> sizes_;
  std::vector<std::uint64_t> counts_;
  std::optional<std::uint64_t> width_;
  std::optional<std::uint64_t> height_;
  std::optional<std::uint64_t> points_;
  std::optional<Eigen::Vector3d> viewpoint_;
};

}  // namespace

std::size_t PcdHeader::offset(std::size_t field) const {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < field; ++i) bytes += fields[i].type.bytes * fields[i].count;
  return bytes;
}

std::size_t PcdHeader::stride() const { return offset(fields.size()); }

PcdHeader read_pcd_header(TextLines& lines) {
  PcdHeaderLines header(lines);
  while (const auto line = lines.next_filled()) {
    if (line->starts_with('#')) continue;
    std::string_view words = *line;
    const std::string_view key = take_word(words);
    if (key == "DATA") return header.finish(words_of(words));
    header.take(key, words_of(words));
  }
  lines.fail("the header has no end");
}

}  // namespace adit
