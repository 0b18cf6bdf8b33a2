// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace adit {

/// The allowed range of a number in the configuration, given where the parameter is visited:
/// `v("share", share, within(0.0, 1.0));`. The default allows every finite number.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_allowed = true;  ///< whether the range includes `min`

  [[nodiscard]] bool allow(double value) const;
  [[nodiscard]] bool is_unbounded() const;
  /// "> 0", ">= 2", "0 to 1", "> 0, <= 1".
  [[nodiscard]] std::string text() const;
};

/// The allowed values of a name in the configuration: `v("up", up, OneOf({"x", "y", "z"}));`.
struct OneOf {
  explicit OneOf(std::vector<std::string_view> allowed) : names(std::move(allowed)) {}

  std::vector<std::string_view> names;

  [[nodiscard]] bool allow(std::string_view name) const;
  /// "x, y or z".
  [[nodiscard]] std::string text() const;
};

constexpr Bounds at_least(double min) { return {.min = min}; }
constexpr Bounds above(double min) { return {.min = min, .min_allowed = false}; }
constexpr Bounds within(double min, double max) { return {.min = min, .max = max}; }
constexpr Bounds above_up_to(double min, double max) {
  return {.min = min, .max = max, .min_allowed = false};
}

}  // namespace adit
