// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/xyz_reader.hpp"

#include <algorithm>
#include <cctype>

#include "common/config/number_text.hpp"
#include "tools/cloud/text_lines.hpp"

namespace adit {
namespace {

std::optional<Eigen::Vector3d> point_of(std::string_view tokens) {
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = parse_number<double>(take_token(tokens));
    if (!value) return std::nullopt;
    p[axis] = *value;
  }
  return p;
}

bool names_columns(std::string_view tokens) {
  const std::string_view first = take_token(tokens);
  return (first[0] == 'x' || first[0] == 'X') &&
         std::all_of(tokens.begin(), tokens.end(), [](char c) {
           return std::isprint(static_cast<unsigned char>(c)) != 0 || c == '\t';
         });
}

}  // namespace

PointCloud read_xyz(std::span<const std::uint8_t> bytes) {
  TextLines lines(bytes);
  PointCloud cloud;
  bool first = true;
  while (const auto line = lines.next_nonblank()) {
    std::string_view tokens = *line;
    const std::string_view token = take_token(tokens);
    if (token.starts_with('#') || token.starts_with("//")) continue;
    if (const auto p = point_of(*line)) {
      cloud.add(*p);
    } else if (!first || !names_columns(*line)) {
      lines.fail("it does not begin with three numbers");
    }
    first = false;
  }
  return cloud;
}

}  // namespace adit
