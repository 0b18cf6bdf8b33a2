// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/proportions.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPublished = 5e-5;  // four decimals

/// Newcombe, Two-sided confidence intervals for the single proportion, Statistics in Medicine 17,
/// 1998, table I, method 3.
TEST(WilsonInterval, IsThatOfPublishedTables) {
  const auto expect = [](int count, int total, double lower, double upper) {
    const ShareInterval interval = wilson_interval(count, total);
    EXPECT_NEAR(interval.lower, lower, kPublished) << count << " of " << total;
    EXPECT_NEAR(interval.upper, upper, kPublished) << count << " of " << total;
  };
  expect(81, 263, 0.2553, 0.3662);
  expect(15, 148, 0.0624, 0.1605);
  expect(0, 20, 0.0, 0.1611);
  expect(1, 29, 0.0061, 0.1718);
}

TEST(WilsonInterval, SolvesTheScoreEquation) {
  const double z = 1.959963984540054;
  for (int count = 1; count < 40; ++count) {
    const ShareInterval interval = wilson_interval(count, 40);
    for (const double bound : {interval.lower, interval.upper}) {
      const double deviation = std::sqrt(bound * (1.0 - bound) / 40.0);
      EXPECT_NEAR(std::abs(count / 40.0 - bound), z * deviation, 1e-12);
    }
  }
}

TEST(WilsonInterval, IsEverythingWithoutObservations) {
  EXPECT_EQ(wilson_interval(0, 0).lower, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).upper, 1.0);
  EXPECT_EQ(wilson_interval(7, 7).upper, 1.0);
}

/// The campaign stops at the first interval that is narrow enough; the interval must then still
/// cover the share about as often as it says.
TEST(WilsonInterval, CoversTheShareWhereSamplingStopsAtAWidth) {
  std::mt19937 random(1);
  for (const double share : {0.03, 0.2, 0.5, 0.97}) {
    constexpr int kRuns = 2000;
    int covered = 0;
    for (int run = 0; run < kRuns; ++run) {
      std::bernoulli_distribution draw(share);
      int count = 0;
      int total = 0;
      do {
        count += draw(random) ? 1 : 0;
        ++total;
      } while (total < 20 || wilson_interval(count, total).width() >= 0.1);
      const ShareInterval interval = wilson_interval(count, total);
      covered += interval.lower <= share && share <= interval.upper;
    }
    // Of a fixed number of draws, too, the coverage of 95 % varies from 93 % with the share.
    EXPECT_GT(covered, 0.92 * kRuns) << share;
  }
}

TEST(McNemarTest, IsTheBinomialTail) {
  EXPECT_NEAR(mcnemar_p(1, 9), 2.0 * (1.0 + 10.0) / 1024.0, 1e-12);
  EXPECT_NEAR(mcnemar_p(9, 1), mcnemar_p(1, 9), 1e-15);
  EXPECT_NEAR(mcnemar_p(0, 6), 2.0 / 64.0, 1e-12);
  EXPECT_EQ(mcnemar_p(0, 0), 1.0);
  EXPECT_EQ(mcnemar_p(5, 5), 1.0);
}

/// 0.4857: Fisher's lady tasting tea, as R's fisher.test; 0.0350: the example of SciPy.
TEST(FisherTest, IsThatOfOtherPrograms) {
  EXPECT_NEAR(fisher_p(3, 4, 1, 4), 34.0 / 70.0, 1e-12);
  EXPECT_NEAR(fisher_p(8, 10, 1, 6), 0.034965034965, 1e-9);
  EXPECT_NEAR(fisher_p(0, 10, 0, 20), 1.0, 1e-12);
  EXPECT_LT(fisher_p(990, 1000, 950, 1000), 1e-6);
}

}  // namespace
}  // namespace adit
