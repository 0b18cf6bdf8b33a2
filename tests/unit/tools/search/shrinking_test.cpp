// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/shrinking.hpp"

#include <functional>
#include <optional>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using Kind = SpaceParameter::Kind;
using testing::ElementsAre;

/// Damage from 0 to 1, a length from 30 to 80, one of four topologies, a bias of −1 to 1, a seed.
SearchSpace mine_space() {
  SearchSpace space;
  const auto add = [&](Kind kind, double from, double to, double simple) {
    SpaceParameter parameter;
    parameter.kind = kind;
    parameter.from = from;
    parameter.to = to;
    parameter.simple = simple;
    space.parameters.push_back(parameter);
  };
  add(Kind::kReal, 0.0, 1.0, 0.0);
  add(Kind::kInteger, 30.0, 80.0, 30.0);
  add(Kind::kChoice, 0.0, 3.0, 0.0);
  add(Kind::kReal, -1.0, 1.0, 0.0);
  add(Kind::kSeed, 1.0, 1e6, 1.0);
  return space;
}

const SearchPoint kFailing{0.913, 77, 3, -0.62, 4711};

struct Shrunk {
  ShrunkPoint result;
  int batches = 0;
};

Shrunk shrunk(const std::function<bool(const SearchPoint&)>& fails, int evaluated_max = 200) {
  Shrunk shrunk;
  const SearchSpace space = mine_space();
  std::set<SearchPoint> seen;
  shrunk.result =
      shrink(space, kFailing, evaluated_max, [&](const std::vector<SearchPoint>& points) {
        ++shrunk.batches;
        std::vector<bool> results;
        for (const SearchPoint& point : points) {
          EXPECT_TRUE(seen.insert(point).second) << "evaluated twice";
          results.push_back(fails(point));
        }
        return std::optional(results);
      });
  EXPECT_TRUE(fails(shrunk.result.point));
  EXPECT_EQ(shrunk.result.evaluated, static_cast<int>(seen.size()));
  return shrunk;
}

TEST(Shrinking, FindsThatNothingMatters) {
  const auto [result, batches] = shrunk([](const auto&) { return true; });
  EXPECT_THAT(result.point, ElementsAre(0, 30, 0, 0, 1));
  EXPECT_EQ(result.evaluated, 1);
  EXPECT_TRUE(result.is_minimal);
}

TEST(Shrinking, FindsTheThresholdOfTheOneParameterThatMatters) {
  const auto [result, batches] = shrunk([](const SearchPoint& point) { return point[0] > 0.4; });
  EXPECT_GT(result.point[0], 0.4);
  EXPECT_LT(result.point[0], 0.43);  // 2 % of the range, and a step of 0.01
  EXPECT_THAT(SearchPoint(result.point.begin() + 1, result.point.end()), ElementsAre(30, 0, 0, 1));
  EXPECT_TRUE(result.is_minimal);
  EXPECT_LT(result.evaluated, 25);
}

TEST(Shrinking, FindsSeveralThresholdsTogether) {
  const auto [result, batches] = shrunk(
      [](const SearchPoint& point) { return point[1] >= 51 && point[2] >= 2 && point[3] < -0.3; });
  EXPECT_EQ(result.point[0], 0);
  EXPECT_NEAR(result.point[1], 51, 1.0);  // 2 % of the range
  EXPECT_EQ(result.point[2], 2);
  EXPECT_NEAR(result.point[3], -0.3, 0.05);  // 2 % of the range, and a step of 0.01
  EXPECT_EQ(result.point[4], 1);
}

TEST(Shrinking, KeepsOneOfTwoParametersEachOfWhichSuffices) {
  const auto [result, batches] =
      shrunk([](const SearchPoint& point) { return point[1] > 60 || point[2] == 3; });
  EXPECT_NE(result.point[1] == 30, result.point[2] == 0);
}

TEST(Shrinking, TriesTheSmallestSeeds) {
  const auto [result, batches] =
      shrunk([](const SearchPoint& point) { return point[4] == 4711 || point[4] == 3; });
  EXPECT_THAT(result.point, ElementsAre(0, 30, 0, 0, 3));
  const auto [kept, more] = shrunk([](const SearchPoint& point) { return point[4] == 4711; });
  EXPECT_THAT(kept.point, ElementsAre(0, 30, 0, 0, 4711));
}

TEST(Shrinking, EndsAtItsLimitWithAPointThatFails) {
  const auto [result, batches] =
      shrunk([](const SearchPoint& point) { return point[0] > 0.4 && point[1] > 40; }, 9);
  EXPECT_LE(result.evaluated, 9);
  EXPECT_FALSE(result.is_minimal);
  EXPECT_THAT(SearchPoint(result.point.begin() + 2, result.point.end()), ElementsAre(0, 0, 1));
}

TEST(Shrinking, EndsWhenTheRunIsStopped) {
  const ShrunkPoint result = shrink(mine_space(), kFailing, 100,
                                    [](const auto&) { return std::optional<std::vector<bool>>(); });
  EXPECT_EQ(result.point, kFailing);
  EXPECT_FALSE(result.is_minimal);
}

}  // namespace
}  // namespace adit
