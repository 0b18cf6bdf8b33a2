// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/placement.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

void require_along(const DriftLine& drift, double at_m, const std::string& what) {
  if (at_m >= 0.0 && at_m <= drift.length_m()) return;
  throw std::invalid_argument(what + ": " + number_text(at_m) + " m is not along drift '" +
                              drift.name + "', which is " + number_text(drift.length_m()) +
                              " m long");
}

}  // namespace

const DriftLine& drift_with(const std::vector<DriftLine>& drifts, const std::string& name,
                            double at_m, const std::string& what) {
  const DriftLine& drift = find_drift(drifts, name, what);
  require_along(drift, at_m, what);
  return drift;
}

const DriftLine& drift_with(const std::vector<DriftLine>& drifts, const std::string& name,
                            double from_m, double to_m, const std::string& what) {
  const DriftLine& drift = drift_with(drifts, name, from_m, what);
  require_along(drift, to_m, what);
  if (to_m > from_m) return drift;
  throw std::invalid_argument(what + ": ends at " + number_text(to_m) + " m, and begins at " +
                              number_text(from_m) + " m");
}

std::vector<double> places_between(double from_m, double to_m, double step_m) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to_m - from_m) / step_m)));
  std::vector<double> places;
  for (int i = 0; i <= steps; ++i) places.push_back(from_m + (to_m - from_m) * i / steps);
  return places;
}

}  // namespace adit
