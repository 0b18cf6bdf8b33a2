// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Functions with known, rare failures. Parameters of the method are tuned on seeds 1 to 40; the
// tests have others.
#include "tools/search/cross_entropy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using Function = std::function<Evaluation(const SearchPoint&, std::mt19937_64&)>;

constexpr int kUnitsMax = 20'000;
constexpr std::uint64_t kFirstSeed = 41;
constexpr std::uint64_t kLastSeed = 80;

/// `ranges` from 0 to 1, then a choice of four, then a seed.
SearchSpace space_of(int ranges) {
  SearchSpace space;
  for (int i = 0; i < ranges; ++i) {
    SpaceParameter range;
    range.name = "x" + std::to_string(i);
    space.parameters.push_back(range);
  }
  SpaceParameter choice;
  choice.name = "choice";
  choice.kind = SpaceParameter::Kind::kChoice;
  choice.to = 3.0;
  choice.choices.assign(4, {"a", false, false});
  space.parameters.push_back(choice);
  SpaceParameter seed;
  seed.name = "seed";
  seed.kind = SpaceParameter::Kind::kSeed;
  seed.from = 1.0;
  seed.to = 1e6;
  space.parameters.push_back(seed);
  return space;
}

/// Units until `kinds` kinds of failure are found.
int units_until_found(const Function& function, int ranges, std::size_t kinds, double uniform_share,
                      std::uint64_t seed) {
  const SearchSpace space = space_of(ranges);
  CrossEntropyParams params;
  params.uniform_share = uniform_share;
  CrossEntropy search(space, params, seed);
  std::mt19937_64 noise(seed + 1000);
  std::set<std::string> found;
  int units = 0;
  while (units < kUnitsMax) {
    std::vector<Evaluation> evaluations;
    for (const SearchPoint& point : search.sample()) {
      evaluations.push_back(function(point, noise));
      ++units;
      if (!evaluations.back().kind.empty()) found.insert(evaluations.back().kind);
      if (found.size() == kinds) return units;
    }
    search.update(evaluations);
  }
  return kUnitsMax;
}

/// Over the seeds of the test.
double median_units(const Function& function, int ranges, std::size_t kinds,
                    double uniform_share = CrossEntropyParams{}.uniform_share) {
  std::vector<int> units;
  for (std::uint64_t seed = kFirstSeed; seed <= kLastSeed; ++seed)
    units.push_back(units_until_found(function, ranges, kinds, uniform_share, seed));
  std::ranges::sort(units);
  return units[units.size() / 2];
}

/// Fails in 0.05 % of a space of six ranges: a corner in two, a stripe in a third.
Evaluation corner(const SearchPoint& x, std::mt19937_64&) {
  const double off = std::max({0.95 - x[0], x[1] - 0.05, std::abs(x[2] - 0.6) - 0.1, 0.0});
  return {-off, off == 0.0 ? "corner" : ""};
}

/// Fails in 0.25 %, for one of four choices. The severity has noise with a standard deviation of
/// two thirds of what the choice makes, and is missing for one point of ten.
Evaluation noisy(const SearchPoint& x, std::mt19937_64& random) {
  const double off = std::hypot(x[0] - 0.2, x[3] - 0.8);
  std::normal_distribution<double> noise(0.0, 0.2);
  Evaluation evaluation{(x[4] == 2.0 ? 0.3 : 0.0) - off + noise(random), ""};
  if (random() % 10 == 0) evaluation.severity.reset();
  if (off < 0.056 && x[4] == 2.0) evaluation.kind = "noisy";
  return evaluation;
}

/// Two failures, in 1.6 % and 0.05 % of the space, the severity of which rises to the nearer one.
Evaluation two_kinds(const SearchPoint& x, std::mt19937_64&) {
  const double wide = std::hypot(x[0] - 0.8, x[1] - 0.8, x[2] - 0.5);
  const double narrow = std::hypot(x[0] - 0.15, x[1] - 0.2, x[2] - 0.5);
  Evaluation evaluation{-std::min(wide, narrow), ""};
  if (wide < 0.16) evaluation.kind = "wide";
  if (narrow < 0.05) evaluation.kind = "narrow";
  return evaluation;
}

// Measured: 164 of 1,799 units, 83 of 359, 194 of 1,122.

TEST(CrossEntropy, FindsARareFailureWithFarFewerUnitsThanUniformSampling) {
  EXPECT_LT(median_units(corner, 6, 1), 0.15 * median_units(corner, 6, 1, 1.0));
}

TEST(CrossEntropy, FindsAFailureOfOneChoiceInNoise) {
  EXPECT_LT(median_units(noisy, 4, 1), 0.35 * median_units(noisy, 4, 1, 1.0));
}

TEST(CrossEntropy, FindsASecondKindBesideAFrequentOne) {
  EXPECT_LT(median_units(two_kinds, 3, 2), 0.25 * median_units(two_kinds, 3, 2, 1.0));
}

TEST(CrossEntropy, IsUniformSamplingWithoutASeverity) {
  const SearchSpace space = space_of(1);
  CrossEntropy search(space, {}, 1);
  double sum = 0.0;
  int count = 0;
  for (int batch = 0; batch < 50; ++batch) {
    const std::vector<SearchPoint> points = search.sample();
    for (const SearchPoint& point : points) {
      sum += point[0];
      ++count;
    }
    search.update(std::vector<Evaluation>(points.size()));
  }
  EXPECT_NEAR(sum / count, 0.5, 0.1);  // the centres of 16 restarts have a mean of sd 0.07
}

TEST(CrossEntropy, DrawsTheSamePointsForTheSameSeed) {
  const SearchSpace space = space_of(2);
  CrossEntropy a(space, {}, 7);
  CrossEntropy b(space, {}, 7);
  CrossEntropy other(space, {}, 8);
  for (int batch = 0; batch < 3; ++batch) {
    const std::vector<SearchPoint> points = a.sample();
    EXPECT_EQ(b.sample(), points);
    EXPECT_NE(other.sample(), points);
    std::vector<Evaluation> evaluations;
    for (const SearchPoint& point : points) evaluations.push_back({point[0], ""});
    a.update(evaluations);
    b.update(evaluations);
    other.update(evaluations);
  }
}

TEST(CrossEntropy, DrawsWithinTheSpace) {
  SearchSpace space = space_of(1);
  space.parameters[0].kind = SpaceParameter::Kind::kInteger;
  space.parameters[0].from = 3.0;
  space.parameters[0].to = 5.0;
  CrossEntropy search(space, {}, 1);
  std::set<double> integers;
  std::set<double> choices;
  for (int batch = 0; batch < 5; ++batch) {
    std::vector<Evaluation> evaluations;
    for (const SearchPoint& point : search.sample()) {
      integers.insert(point[0]);
      choices.insert(point[1]);
      evaluations.push_back({point[0], ""});
    }
    search.update(evaluations);
  }
  EXPECT_THAT(integers, testing::ElementsAre(3.0, 4.0, 5.0));
  EXPECT_THAT(choices, testing::ElementsAre(0.0, 1.0, 2.0, 3.0));
}

}  // namespace
}  // namespace adit
