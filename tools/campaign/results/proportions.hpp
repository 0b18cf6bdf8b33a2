// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

/// Bounds of a share, 0 to 1.
struct ShareInterval {
  double lower = 0.0;
  double upper = 1.0;

  [[nodiscard]] double width() const { return upper - lower; }
};

/// The 95 % score interval of a share of which `count` of `total` were observed (Wilson, Probable
/// inference, JASA 22, 1927). 0 to 1 without observations.
ShareInterval wilson_interval(int count, int total);

/// Exact two-sided McNemar test of paired observations: the probability that, of `only_first` +
/// `only_second` pairs that differ, so few or fewer fall on one side if both sides are equally
/// likely (binomial, doubled, at most 1). 1 if no pair differs.
double mcnemar_p(int only_first, int only_second);

/// Fisher's exact two-sided test of two independent shares: the probability of all tables with
/// the same margins that are at most as likely as `count1` of `total1` and `count2` of `total2`
/// (Fisher, Statistical Methods for Research Workers, 1934; as R's fisher.test).
double fisher_p(int count1, int total1, int count2, int total2);

}  // namespace adit
