// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/number_list.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

[[noreturn]] void fail(const std::string& option, const std::string& text, const std::string& why) {
  throw std::invalid_argument(option + ": '" + text + "' " + why);
}

}  // namespace

std::vector<double> parse_number_list(const std::string& option, const std::string& text,
                                      std::size_t least, std::size_t most) {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const auto number = parse_number<double>(std::string_view(text).substr(from, to - from));
    if (!number || !std::isfinite(*number)) fail(option, text, "is not numbers between commas");
    numbers.push_back(*number);
    from = to + 1;
  }
  if (numbers.size() < least || numbers.size() > most) {
    const std::string or_most = most > least ? " or " + std::to_string(most) : "";
    fail(option, text, "should be " + std::to_string(least) + or_most + " numbers");
  }
  return numbers;
}

}  // namespace adit
