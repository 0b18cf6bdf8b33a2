// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/loop_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A straight odometry of 1,000 steps.
std::vector<PoseConstraint> odometry() {
  std::vector<PoseConstraint> chain;
  for (int i = 0; i < 1000; ++i) {
    chain.push_back({i, i + 1, {1.0, 0.0, 0.0}, 100.0 * Eigen::Matrix3d::Identity()});
  }
  return chain;
}

PoseConstraint loop(int from, int to) {
  return {from, to, {}, 400.0 * Eigen::Matrix3d::Identity()};
}

TEST(LoopOrder, BeginsWithTheShortestLoops) {
  LoopOrder order(odometry(), {}, {loop(100, 900), loop(100, 250), loop(400, 500), loop(300, 600)});
  EXPECT_THAT(order.most_certain(9, {}), ElementsAre(2, 1));  // others: over twice as uncertain
  EXPECT_THAT(order.most_certain(1, {}), ElementsAre(2));
  order.take({2, 1});
  EXPECT_FALSE(order.is_pending(1));
  EXPECT_TRUE(order.is_pending(3));
  EXPECT_THAT(order.most_certain(9, {}), ElementsAre(3));
  order.take({0, 3, 3});
  EXPECT_THAT(order.most_certain(9, {}), IsEmpty());
}

/// A loop that begins and ends near an accepted one is as certain as that.
TEST(LoopOrder, AcceptedLoopsMakeOthersMoreCertain) {
  LoopOrder order(odometry(), {}, {loop(100, 900), loop(120, 890), loop(300, 600)});
  order.take({0});
  EXPECT_THAT(order.most_certain(1, {}), ElementsAre(2));
  EXPECT_THAT(order.most_certain(1, {0}), ElementsAre(1));
}

/// The uncertainty of the odometry counts, not its number of steps.
TEST(LoopOrder, CountsTheVarianceOfTheOdometry) {
  std::vector<PoseConstraint> chain = odometry();
  for (int i = 400; i < 450; ++i) chain[static_cast<std::size_t>(i)].information *= 0.01;
  LoopOrder order(chain, {}, {loop(390, 460), loop(500, 900)});
  EXPECT_THAT(order.most_certain(1, {}), ElementsAre(1));
}

TEST(LoopOrder, IsEmptyWithoutLoops) {
  EXPECT_THAT(LoopOrder({}, {}, {}).most_certain(5, {}), IsEmpty());
  EXPECT_THAT(LoopOrder(odometry(), {}, {}).most_certain(5, {}), IsEmpty());
}

}  // namespace
}  // namespace adit
