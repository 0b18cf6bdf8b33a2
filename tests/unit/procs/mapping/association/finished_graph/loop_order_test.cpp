// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/loop_order.hpp"

#include <vector>

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

std::vector<int> most_certain(const LoopOrder& order, std::size_t most,
                              const std::vector<int>& accepted) {
  return order.most_certain(most, accepted).most_certain;
}

PoseConstraint loop(int from, int to) {
  return {from, to, {}, 400.0 * Eigen::Matrix3d::Identity()};
}

TEST(LoopOrder, BeginsWithTheShortestLoops) {
  LoopOrder order(odometry(), {}, {loop(100, 900), loop(100, 250), loop(400, 500), loop(300, 600)});
  EXPECT_THAT(most_certain(order, 9, {}), ElementsAre(2, 1));  // others: over twice as uncertain
  EXPECT_THAT(most_certain(order, 1, {}), ElementsAre(2));
  order.take({2, 1});
  EXPECT_FALSE(order.is_pending(1));
  EXPECT_TRUE(order.is_pending(3));
  EXPECT_THAT(most_certain(order, 9, {}), ElementsAre(3));
  order.take({0, 3, 3});
  EXPECT_THAT(most_certain(order, 9, {}), IsEmpty());
}

/// A loop that begins and ends near an accepted one is as certain as that.
TEST(LoopOrder, AcceptedLoopsMakeOthersMoreCertain) {
  LoopOrder order(odometry(), {}, {loop(100, 900), loop(120, 890), loop(300, 600)});
  order.take({0});
  EXPECT_THAT(most_certain(order, 1, {}), ElementsAre(2));
  EXPECT_THAT(most_certain(order, 1, {0}), ElementsAre(1));
}

/// The uncertainty of the odometry counts, not its number of steps.
TEST(LoopOrder, CountsTheVarianceOfTheOdometry) {
  std::vector<PoseConstraint> chain = odometry();
  for (int i = 400; i < 450; ++i) chain[static_cast<std::size_t>(i)].information *= 0.01;
  LoopOrder order(chain, {}, {loop(390, 460), loop(500, 900)});
  EXPECT_THAT(most_certain(order, 1, {}), ElementsAre(1));
}

/// Eight loops are accepted: a quarter of them is offered, though the second is less certain.
TEST(LoopOrder, OffersFurtherLoopsWhereManyAreAccepted) {
  std::vector<PoseConstraint> loops = {loop(100, 120), loop(300, 700), loop(200, 900)};
  std::vector<int> accepted;
  for (int i = 0; i < 8; ++i) {
    accepted.push_back(static_cast<int>(loops.size()));
    loops.push_back(loop(0, 1));
  }
  LoopOrder order(odometry(), {}, loops);
  order.take(accepted);
  EXPECT_THAT(order.most_certain(9, accepted).most_certain, ElementsAre(0));
  EXPECT_THAT(order.most_certain(9, accepted).further, ElementsAre(1));
  EXPECT_THAT(order.most_certain(9, {}).further, IsEmpty());
}

TEST(LoopOrder, IsEmptyWithoutLoops) {
  EXPECT_THAT(most_certain(LoopOrder({}, {}, {}), 5, {}), IsEmpty());
  EXPECT_THAT(most_certain(LoopOrder(odometry(), {}, {}), 5, {}), IsEmpty());
}

}  // namespace
}  // namespace adit
