// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/loop_closure_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

Eigen::Matrix3d sure_to(double sd_m) {
  return Eigen::Vector3d(sd_m * sd_m, sd_m * sd_m, 1e-4).asDiagonal();
}

/// A path of local maps in a long tunnel, all with the same walls.
struct MappedPath {
  std::vector<Pose2> poses;
  std::vector<NearMap> near;
  std::vector<MapExtent> extents;

  void add(const Pose2& T_map_local, double sd_m) {
    static const MapExtent extent(test::walls_of(test::straight_tunnel(20.0, 3.0),
                                                 {-2.5, 0.0, 0.0}));  // 20 m by 3 m around it
    poses.push_back(T_map_local);
    near.push_back({static_cast<int>(near.size()), sure_to(sd_m)});
    extents.push_back(extent);
  }

  [[nodiscard]] std::vector<int> older(const LoopClosureCandidatesParams& params = {}) const {
    std::vector<int> found;
    for (const auto& c : loop_closure_candidates(poses, near, extents, params)) {
      found.push_back(c.older);
    }
    return found;
  }
};

/// 10 maps along x, then back at a distance of `beside_m`, the newest beside the 3rd.
MappedPath out_and_back(double beside_m, double sd_m) {
  MappedPath mapped;
  for (int i = 0; i < 10; ++i) mapped.add({5.0 * i, 0.0, 0.0}, sd_m);
  for (int i = 9; i >= 2; --i) mapped.add({5.0 * i, beside_m, 0.0}, sd_m);
  return mapped;
}

TEST(LoopClosureCandidates, AreMapsWithOverlappingWalls) {
  const auto found = out_and_back(0.0, 0.1).older();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front(), 2);
}

TEST(LoopClosureCandidates, ExcludeNeighboursInTheChain) {
  MappedPath mapped;
  for (int i = 0; i < 4; ++i) mapped.add({0.5 * i, 0.0, 0.0}, 0.1);
  EXPECT_EQ(mapped.older(), std::vector<int>{0});
  mapped.poses.resize(3);
  EXPECT_TRUE(mapped.older().empty());
  EXPECT_TRUE(MappedPath{}.older().empty());
}

TEST(LoopClosureCandidates, DependOnTheUncertaintyOfThePose) {
  EXPECT_TRUE(out_and_back(30.0, 0.1).older().empty());
  EXPECT_FALSE(out_and_back(30.0, 12.0).older().empty());
}

/// A place seven standard deviations from the prediction.
TEST(LoopClosureCandidates, AreFartherAwayWhenThorough) {
  const MappedPath mapped = out_and_back(28.0, 4.0);
  const auto outbound = [](int older) { return older < 10; };
  EXPECT_TRUE(std::ranges::none_of(mapped.older(), outbound));
  const auto found = thorough_candidates(mapped.poses, mapped.near, mapped.extents, {});
  const auto far = std::ranges::find_if(found, outbound, &LoopClosureCandidate::older);
  ASSERT_NE(far, found.end());
  EXPECT_NEAR(far->predicted.covariance(0, 0), 9.0 * 4.0 * 4.0, 1e-9);
}

/// Those within what the standard deviations state come first, as they are.
TEST(LoopClosureCandidates, AreTheLikelyOnesFirstWhenThorough) {
  const MappedPath mapped = out_and_back(2.0, 4.0);
  LoopClosureCandidatesParams more;
  more.most *= 4;
  const std::vector<int> likely = mapped.older(more);
  ASSERT_FALSE(likely.empty());
  const auto found = thorough_candidates(mapped.poses, mapped.near, mapped.extents, {});
  ASSERT_GE(found.size(), likely.size());
  for (std::size_t i = 0; i < likely.size(); ++i) EXPECT_EQ(found[i].older, likely[i]);
  EXPECT_NEAR(found.front().predicted.covariance(0, 0), 4.0 * 4.0, 1e-9);
}

TEST(LoopClosureCandidates, AreFewAndDistinct) {
  MappedPath mapped = out_and_back(0.0, 20.0);
  for (int i = 0; i < 40; ++i) mapped.add({12.0 + 0.1 * i, 0.0, 0.0}, 20.0);
  LoopClosureCandidatesParams params;
  const auto found = mapped.older(params);
  EXPECT_EQ(static_cast<int>(found.size()), params.most);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(std::abs(found[i] - found[j]), params.apart);
    }
  }
  EXPECT_EQ(found, mapped.older(params));
}

TEST(MapExtent, OverlapsItselfCompletelyAndDistantMapsNot) {
  const MapExtent extent(test::walls_of(test::straight_tunnel(20.0, 3.0), {-2.5, 0.0, 0.0}));
  EXPECT_EQ(extent.overlap(extent, {}), 1.0);
  EXPECT_EQ(extent.overlap(extent, {0.0, 10.0, 0.0}), 0.0);
  EXPECT_EQ(extent.overlap(MapExtent{}, {}), 0.0);
  const double half = extent.overlap(extent, {0.5 * extent.radius_m(), 0.0, 0.0});
  EXPECT_GT(half, 0.4);
  EXPECT_LT(half, 1.0);
}

TEST(MapExtent, LiesAroundTheWalls) {
  const LocalWalls walls = test::walls_of(test::crooked_room(), {-3.0, 0.0, 0.4}, 2.0);
  const MapExtent extent(walls);
  for (const auto& point : walls.points) {
    EXPECT_LT((point.p - extent.centre()).norm(), extent.radius_m());
  }
}

}  // namespace
}  // namespace adit
