// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/view_options.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

[[noreturn]] void fail(const std::string& text) {
  throw std::invalid_argument(fmt::format("{} is not a pose X,Y,HEADING_DEG", quote(text)));
}

}  // namespace

Pose2 parse_view_pose(const std::string& text) {
  std::array<double, 3> numbers{};
  const char* next = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (next == end || *next++ != ',')) fail(text);
    const auto [after, error] = std::from_chars(next, end, numbers[i]);
    if (error != std::errc() || !std::isfinite(numbers[i])) fail(text);
    next = after;
  }
  if (next != end) fail(text);
  return {numbers[0], numbers[1], wrap_angle(deg_to_rad(numbers[2]))};
}

}  // namespace adit
