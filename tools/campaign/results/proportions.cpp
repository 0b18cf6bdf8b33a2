// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/proportions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace adit {
namespace {

constexpr double kZ95 = 1.959963984540054;  // 97.5 % quantile of the normal distribution

double log_choose(int n, int k) {
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
}

}  // namespace

ShareInterval wilson_interval(int count, int total) {
  if (total <= 0) return {};
  const double n = total;
  const double share = count / n;
  const double z2 = kZ95 * kZ95;
  const double center = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kZ95 / (1.0 + z2 / n) * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n * n));
  // Exact at the ends, where rounding leaves 1e-17.
  return {count == 0 ? 0.0 : std::max(center - half, 0.0),
          count == total ? 1.0 : std::min(center + half, 1.0)};
}

double mcnemar_p(int only_first, int only_second) {
  const int n = only_first + only_second;
  double tail = 0.0;
  for (int k = 0; k <= std::min(only_first, only_second); ++k)
    tail += std::exp(log_choose(n, k) - n * std::numbers::ln2);
  return std::min(1.0, 2.0 * tail);
}

double fisher_p(int count1, int total1, int count2, int total2) {
  const int count = count1 + count2;
  const auto log_probability = [&](int k) {
    return log_choose(total1, k) + log_choose(total2, count - k) -
           log_choose(total1 + total2, count);
  };
  constexpr double kTie = 1e-7;  // relative, for tables that are equally likely but for rounding
  const double observed = log_probability(count1);
  double p = 0.0;
  for (int k = std::max(0, count - total2); k <= std::min(count, total1); ++k) {
    if (log_probability(k) <= observed + kTie) p += std::exp(log_probability(k));
  }
  return std::min(1.0, p);
}

}  // namespace adit
