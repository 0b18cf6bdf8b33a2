// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/bounds.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/number_text.hpp"

namespace adit {

bool Bounds::allow(double value) const {
  return std::isfinite(value) && value <= max && (value > min || (min_allowed && value == min));
}

bool Bounds::is_unbounded() const { return std::isinf(min) && std::isinf(max); }

std::string Bounds::text() const {
  if (std::isinf(min)) return "<= " + number_text(max);
  if (std::isinf(max)) return (min_allowed ? ">= " : "> ") + number_text(min);
  if (min_allowed) return number_text(min) + " to " + number_text(max);
  return "> " + number_text(min) + ", <= " + number_text(max);
}

bool OneOf::allow(std::string_view name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string OneOf::text() const {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " or ";
    text += names[i];
  }
  return text;
}

}  // namespace adit
