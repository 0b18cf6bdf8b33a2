// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/histogram.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::size_t kBinsMax = 30;

/// The smallest value that is not below a share of all; of sorted values, at least one.
double quantile(const std::vector<double>& sorted, double share) {
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

}  // namespace

Histogram measure_histogram(const DistributionDefinition& definition, Database& database) {
  Histogram histogram;
  histogram.name = definition.name;
  std::vector<double> values;
  SqlStatement rows = database.prepare(
      fmt::format("SELECT ({}\n) FROM campaign WHERE state IS NOT NULL", definition.value));
  while (rows.step()) {
    if (rows.is_number(0)) {
      values.push_back(rows.number(0));
    } else {
      ++histogram.without;
    }
  }
  histogram.values = values.size();
  if (values.empty()) return histogram;
  std::ranges::sort(values);
  histogram.min = values.front();
  histogram.max = values.back();
  histogram.median = quantile(values, 0.5);
  histogram.percentile95 = quantile(values, 0.95);
  const double span = histogram.max - histogram.min;
  const auto root = static_cast<std::size_t>(std::ceil(std::sqrt(values.size())));
  histogram.counts.assign(span > 0.0 ? std::clamp<std::size_t>(root, 2, kBinsMax) : 1, 0);
  const auto bins = static_cast<double>(histogram.counts.size());
  for (const double value : values) {
    const double bin = span > 0.0 ? (value - histogram.min) / span * bins : 0.0;
    ++histogram.counts[std::min(static_cast<std::size_t>(bin), histogram.counts.size() - 1)];
  }
  return histogram;
}

}  // namespace adit
