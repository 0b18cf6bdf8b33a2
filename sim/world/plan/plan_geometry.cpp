// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/plan/plan_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace adit {

std::vector<Eigen::Vector2d> corner_list(const std::vector<double>& numbers, std::size_t least,
                                         const std::string& what) {
  if (numbers.size() % 2 != 0) {
    throw std::invalid_argument(what + ": points_m has an x without its y");
  }
  if (numbers.size() / 2 < least) {
    throw std::invalid_argument(what + ": points_m has " + std::to_string(numbers.size() / 2) +
                                " points, at least " + std::to_string(least) + " are needed");
  }
  if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); })) {
    throw std::invalid_argument(what + ": points_m has a number that is not finite");
  }
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    points.emplace_back(numbers[i], numbers[i + 1]);
  return points;
}

}  // namespace adit
