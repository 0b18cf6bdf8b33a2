// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/control/control_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/config/nearest_name.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr std::array<const char*, 9> kColumns{
    "name", "easting_m", "northing_m", "elevation_m", "place", "x_m", "y_m", "z_m", "sd_m"};
constexpr double kControlSdMaxM = 10.0;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    parts.push_back(trimmed(text.substr(from, to - from)));
    from = to + 1;
  }
  return parts;
}

std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The text of control points, row by row.
class ControlParser {
 public:
  ControlParser(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  std::vector<ControlRow> parse() {
    for (const std::string_view line : split(text_, '\n')) {
      ++line_;
      if (line.empty() || line.front() == '#') continue;
      if (columns_.empty()) {
        read_heading(split(line, ','));
      } else {
        cells_ = split(line, ',');
        add_row();
      }
    }
    if (columns_.empty()) fail("no heading: the first line names the columns");
    if (rows_.empty()) fail("no control point");
    return std::move(rows_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(message_line(fmt::format("{}:{}: {}", name_, line_, reason)));
  }

  [[noreturn]] void fail_unknown(const std::string& column,
                                 const std::vector<std::string>& known) const {
    const std::string nearest = nearest_name(column, known);
    const std::string hint =
        nearest.empty() ? "" : fmt::format("; did you mean {}?", quote(nearest));
    fail(fmt::format("unknown column {}{}", quote(column), hint));
  }

  void read_heading(const std::vector<std::string_view>& names) {
    const std::vector<std::string> known(kColumns.begin(), kColumns.end());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string column(names[i]);
      if (std::ranges::find(known, column) == known.end()) fail_unknown(column, known);
      if (!columns_.try_emplace(column, i).second)
        fail(fmt::format("column {} is there twice", quote(column)));
    }
    for (const char* needed : {"name", "easting_m", "northing_m", "place"}) {
      if (!columns_.contains(needed)) fail(fmt::format("no column {}", needed));
    }
  }

  [[nodiscard]] std::string_view cell(const char* column) const {
    const auto found = columns_.find(column);
    if (found == columns_.end() || found->second >= cells_.size()) return {};
    return cells_[found->second];
  }

  /// Nothing for an empty cell.
  [[nodiscard]] std::optional<double> number(const char* column) const {
    const std::string_view text = cell(column);
    if (text.empty()) return std::nullopt;
    const auto value = number_in(text);
    if (!value) fail(fmt::format("{} is no number: {}", column, quote(std::string(text))));
    return value;
  }

  void read_place(ControlRow& row) const {
    const std::vector<std::string_view> words = split(cell("place"), ' ');
    const auto argument = words.size() == 2 ? number_in(words[1]) : std::nullopt;
    if (words.size() == 1 && words[0] == "start") {
      row.place = ControlRow::Place::kStart;
    } else if (words.size() == 1 && words[0] == "map") {
      row.place = ControlRow::Place::kMap;
    } else if (words[0] == "time" && argument && std::abs(*argument) < 1e11) {
      row.place = ControlRow::Place::kTime;
      row.utime = static_cast<std::int64_t>(std::llround(1e6 * *argument));
    } else if (words[0] == "scan" && argument && *argument >= 1.0 && *argument < 1e6) {
      row.place = ControlRow::Place::kScan;
      row.scan = static_cast<int>(*argument);
    } else {
      fail(fmt::format("place is start, map, \"time SECONDS\" or \"scan NUMBER\", not {}",
                       quote(std::string(cell("place")))));
    }
  }

  void add_row() {
    if (cells_.size() > columns_.size())
      fail(fmt::format("{} values in {} columns", cells_.size(), columns_.size()));
    ControlRow row;
    row.line = line_;
    row.name = std::string(cell("name"));
    if (row.name.empty()) fail("a point without a name");
    const auto easting = number("easting_m");
    const auto northing = number("northing_m");
    if (easting.has_value() != northing.has_value()) fail("easting without northing, or reverse");
    if (easting) row.plan = Eigen::Vector2d(*easting, *northing);
    row.elevation_m = number("elevation_m");
    if (!row.plan && !row.elevation_m) fail("neither easting and northing nor elevation");
    read_place(row);
    row.offset = {number("x_m").value_or(0.0), number("y_m").value_or(0.0),
                  number("z_m").value_or(0.0)};
    row.sd_m = number("sd_m").value_or(row.sd_m);
    if (row.sd_m <= 0.0 || row.sd_m > kControlSdMaxM)
      fail(fmt::format("sd_m is above 0 and up to {:.0f}", kControlSdMaxM));
    require_new(row);
    rows_.push_back(std::move(row));
  }

  void require_new(const ControlRow& row) const {
    for (const ControlRow& other : rows_) {
      const auto is_twice = [&](const char* what) {
        fail(fmt::format("{} {} {} of line {}: a point that is given twice?", quote(row.name), what,
                         quote(other.name), other.line));
      };
      if (other.name == row.name) is_twice("has the same name as");
      if (row.plan && other.plan && (*row.plan - *other.plan).norm() < 1e-3)
        is_twice("has the same coordinates as");
      if (row.place == other.place && row.utime == other.utime && row.scan == other.scan &&
          (row.offset - other.offset).norm() < 1e-3 && (!row.plan == !other.plan))
        is_twice("is at the same place of the mission as");
    }
  }

  std::string_view text_;
  std::string name_;
  std::map<std::string, std::size_t, std::less<>> columns_;
  std::vector<std::string_view> cells_;
  int line_ = 0;
  std::vector<ControlRow> rows_;
};

}  // namespace

std::vector<ControlRow> parse_control(std::string_view text, const std::string& name) {
  return ControlParser(text, name).parse();
}

std::vector<ControlRow> read_control(const std::filesystem::path& path) {
  return parse_control(read_text_file(path), path.string());
}

}  // namespace adit
