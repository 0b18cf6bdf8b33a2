// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/order_statistics.hpp"

#include <algorithm>
#include <cstddef>

namespace adit {
namespace {

double nth(std::vector<double>& values, std::size_t n) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  return nth(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

double median(std::vector<double> values) { return nth(values, values.size() / 2); }

}  // namespace adit
