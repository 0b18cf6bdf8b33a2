// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/stub_register.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
const Eigen::Vector2d kEnd{10.0, 0.0};

/// A square of free cells, 8 m wide, around the body.
KnownTile tile() {
  KnownTile tile;
  for (int row = -40; row <= 40; ++row) {
    for (int column = -40; column <= 40; ++column) tile.free.emplace_back(column, row);
  }
  tile.way = {{0.0, 0.0}};
  return tile;
}

/// A stub that local map 0 saw from afar, and that closed when local map 1 looked there.
class ClosedStub : public testing::Test {
 protected:
  ClosedStub() {
    look_from({4.0, 0.0, 0.0});
    update({{kEnd}});
    look_from({8.0, 0.0, 0.0});
    update({});
  }

  void look_from(const Pose2& T_map_local) {
    space_.add(static_cast<int>(poses_.size()), tile());
    poses_.push_back(T_map_local);
    space_.pose(poses_);
  }
  void update(const std::vector<OpenEnd>& ends) {
    utime_ += 1'000'000;
    stubs_.update(ends, space_, {}, utime_);
  }
  [[nodiscard]] StubState state() const { return stubs_.find(0)->state; }

  KnownSpace space_{KnownSpaceParams{}};
  std::vector<Pose2> poses_;
  StubRegister stubs_{StubRegisterParams{}};
  std::int64_t utime_ = kUtime;
};

TEST_F(ClosedStub, IsExplored) {
  EXPECT_EQ(state(), StubState::kExplored);
  EXPECT_EQ(stubs_.find(0)->evidence, "what lies there was seen by local map 1");
}

TEST_F(ClosedStub, StaysClosedWhereASeamOpensThatNobodyHasSeen) {
  look_from({100.0, 0.0, 0.0});
  update({{kEnd + Eigen::Vector2d(0.3, 0.4)}});
  EXPECT_EQ(state(), StubState::kExplored);
  EXPECT_EQ(stubs_.stubs().size(), 1U);
}

TEST_F(ClosedStub, OpensAgainWhereALaterLocalMapSawThePlace) {
  look_from({12.0, 0.0, 0.0});
  update({{kEnd + Eigen::Vector2d(0.3, 0.4)}});
  EXPECT_EQ(state(), StubState::kOpen);
}

/// It is asked of those that came since nothing was open there, not since it was closed.
TEST_F(ClosedStub, StaysClosedWhereThoseThatSawThePlaceFoundNothingOpen) {
  look_from({12.0, 0.0, 0.0});
  update({});
  look_from({100.0, 0.0, 0.0});
  update({{kEnd}});
  EXPECT_EQ(state(), StubState::kExplored);
}

TEST_F(ClosedStub, OpensAgainWhereWhoSawItLiesElsewhereNow) {
  poses_[1].y = 1.0;
  look_from({100.0, 0.0, 0.0});
  update({{kEnd}});
  EXPECT_EQ(state(), StubState::kOpen);
}

TEST_F(ClosedStub, IsAskedForAgainAfterARestart) {
  const std::vector<RememberedStub> remembered = stubs_.remembered();
  stubs_ = StubRegister{StubRegisterParams{}};
  stubs_.restore(remembered);
  look_from({100.0, 0.0, 0.0});
  update({{kEnd}});
  EXPECT_EQ(state(), StubState::kOpen);
}

}  // namespace
}  // namespace adit
