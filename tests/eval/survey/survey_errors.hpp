// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "common/geometry/order_statistics.hpp"
#include "tests/eval/markdown.hpp"

namespace adit {

/// Errors of a quantity, and how many are within their 95 % interval.
struct SurveyErrors {
  std::vector<double> magnitudes;
  double sum = 0.0;
  std::size_t within = 0;

  void add(double error, double sd) {
    constexpr double kSigmas = 1.959964;  // 95 % of a normal distribution
    magnitudes.push_back(std::abs(error));
    sum += error;
    within += std::abs(error) <= kSigmas * sd ? 1U : 0U;
  }
  void add(const SurveyErrors& other) {
    magnitudes.insert(magnitudes.end(), other.magnitudes.begin(), other.magnitudes.end());
    sum += other.sum;
    within += other.within;
  }
  /// Median of the magnitudes, 95 % quantile and mean; "–" without errors.
  [[nodiscard]] std::string magnitude_text(double scale = 1.0) const {
    if (magnitudes.empty()) return "–";
    return format("%.3f (%.3f, %+.3f)", scale * median(magnitudes),
                  scale * quantile(magnitudes, 0.95),
                  scale * sum / static_cast<double>(magnitudes.size()));
  }
  /// The same, and the share within the interval.
  [[nodiscard]] std::string text(double scale = 1.0) const {
    if (magnitudes.empty()) return "–";
    const double share = static_cast<double>(within) / static_cast<double>(magnitudes.size());
    return magnitude_text(scale) + format(", %.0f %%", 100.0 * share);
  }
};

}  // namespace adit
