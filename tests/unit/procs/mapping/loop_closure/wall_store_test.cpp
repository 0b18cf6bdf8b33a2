// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/wall_store.hpp"

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

void expect_same(const LocalWalls& a, const LocalWalls& b) {
  EXPECT_EQ(a.length_m, b.length_m);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const SurfacePoint& p = a.points[i];
    const SurfacePoint& q = b.points[i];
    EXPECT_TRUE(p.p == q.p && p.z_m == q.z_m && p.normal == q.normal && p.weight == q.weight &&
                p.normal_variance == q.normal_variance && p.variance == q.variance &&
                p.lean_sd == q.lean_sd && p.grade_group == q.grade_group &&
                p.pitch_sd_rad == q.pitch_sd_rad && p.beam == q.beam);
  }
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    EXPECT_EQ(a.views[i].free_space.fields(), b.views[i].free_space.fields());
    EXPECT_EQ(a.views[i].T_local_body, b.views[i].T_local_body);
  }
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    EXPECT_EQ(a.path[i].p, b.path[i].p);
    EXPECT_EQ(a.path[i].forward_m, b.path[i].forward_m);
  }
}

class WallStoreTest : public testing::Test {
 protected:
  WallStoreTest() {
    const test::WallWorld mine = test::sample_mine(3);
    for (const double x_m : {3.0, 8.0, 13.0, 18.0}) {
      walls_.push_back(test::walls_of(mine, {x_m, 0.0, 0.0}, 5.0, walls_.size() + 1));
    }
  }

  void fill(WallStore& store) const {
    for (const LocalWalls& walls : walls_) store.push_back(walls);
  }

  test::ScratchFolder folder_;
  std::vector<LocalWalls> walls_;
};

TEST_F(WallStoreTest, ReturnsTheSameBitsFromMemoryAndFile) {
  WallStore in_memory;
  WallStore in_file(folder_.path(), 1);  // the last one only
  for (WallStore* store : {&in_memory, &in_file}) {
    fill(*store);
    for (const std::size_t i : {0U, 3U, 1U, 2U, 1U}) {
      expect_same(*(*store)[i], walls_[i]);
      ASSERT_EQ(store->path(i).size(), walls_[i].path.size());
      EXPECT_EQ(store->path(i).back().p, walls_[i].path.back().p);
    }
    store->pop_back();
    store->pop_back();
    store->push_back(walls_[3]);
    EXPECT_EQ(store->size(), 3U);
    expect_same(*store->back(), walls_[3]);
    expect_same(*(*store)[0], walls_[0]);
  }
}

TEST_F(WallStoreTest, HasOneObjectOfAMapWhileItIsHeld) {
  WallStore store(folder_.path(), 1);
  fill(store);
  const auto held = store[0];
  for (std::size_t i = 0; i < walls_.size(); ++i) EXPECT_NE(store[i], nullptr);
  EXPECT_EQ(store[0], held);
}

}  // namespace
}  // namespace adit
