// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/number_table.hpp"

#include <cmath>
#include <istream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr double kTimeMaxS = 1e11;  // the year 5138

std::optional<double> finite_number(const std::string& token) {
  const auto value = parse_number<double>(token);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

NumberTable::NumberTable(std::istream& in, std::string_view name, std::size_t columns)
    : in_(in), name_(name), columns_(columns) {}

std::optional<std::vector<double>> NumberTable::next() {
  std::string text;
  while (std::getline(in_, text)) {
    ++line_;
    std::istringstream tokens(text.substr(0, text.find('#')));
    std::vector<double> row;
    for (std::string token; tokens >> token;) {
      const auto value = finite_number(token);
      if (!value) fail(fmt::format("{} is not a finite number", quote(token)));
      row.push_back(*value);
    }
    if (row.empty()) continue;
    if (row.size() != columns_) {
      fail(fmt::format("expected {} numbers, found {}", columns_, row.size()));
    }
    return row;
  }
  return std::nullopt;
}

std::int64_t NumberTable::microseconds(double seconds) const {
  if (seconds < 0.0 || seconds > kTimeMaxS) fail("implausible time");
  return std::llround(seconds * 1e6);
}

void NumberTable::fail(std::string_view reason) const {
  throw std::runtime_error(fmt::format("{}:{}: {}", name_, line_, reason));
}

std::istringstream open_table(const std::filesystem::path& path) {
  return std::istringstream(read_text_file(path));
}

}  // namespace adit
