// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "common/config/parse_number.hpp"
#include "tools/cloud/ply_rows.hpp"

namespace adit {
namespace {

using Element = PlyHeader::Element;

}  // namespace

void PlyAsciiRows::require(const Element& element) const {
  // A digit and the end of the line for each.
  if (element.properties.empty() || element.count <= (lines_.rest().size() + 1) / 2) return;
  lines_.fail("the file is too short for the " + std::to_string(element.count) + " of '" +
              element.name + "' that it announces");
}

Eigen::Vector3d PlyAsciiRows::row(const Element& element, const PlyPlaces& places) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  if (element.properties.empty()) return p;
  const auto line = lines_.next_filled();
  if (!line) {
    lines_.fail("the file ends before the " + std::to_string(element.count) + " of '" +
                element.name + "' that it announces");
  }
  std::string_view words = *line;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const double value = number(words);
    if (element.properties[i].count) skip_list(words, value);
    for (int axis = 0; axis < 3; ++axis) {
      if (places[static_cast<std::size_t>(axis)] == i) p[axis] = value;
    }
  }
  return p;
}

double PlyAsciiRows::number(std::string_view& words) const {
  const auto value = parse_number<double>(take_word(words));
  if (!value) lines_.fail("a number is missing, or is none");
  return *value;
}

void PlyAsciiRows::skip_list(std::string_view& words, double count) const {
  if (!(count >= 0.0 && count <= static_cast<double>(words.size()))) {
    lines_.fail("a list that is longer than its line");
  }
  for (auto i = static_cast<std::size_t>(count); i > 0; --i) (void)number(words);
}

}  // namespace adit
