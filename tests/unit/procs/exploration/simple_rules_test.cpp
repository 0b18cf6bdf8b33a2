// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/simple_rules.hpp"

#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr int kNone = -1;

/// Stubs at places of map, offered to a body at the origin, by the straight way.
class AChoice : public testing::Test {
 protected:
  void stub_at(double x, double y) {
    Stub stub;
    stub.id = static_cast<int>(stubs_.size());
    stub.p_map = {x, y};
    offers_.push_back({stub.id, 10.0, stub.p_map.norm(), 50.0});
    stubs_.push_back(stub);
  }
  [[nodiscard]] std::optional<int> choose(const std::string& rule, int target = kNone,
                                          double heading_rad = 0.0) const {
    return choose_by(rule, offers_, stubs_, {0.0, 0.0, heading_rad}, target);
  }

  std::vector<Stub> stubs_;
  std::vector<StubOffer> offers_;
};

TEST_F(AChoice, IsNoneWhereNothingIsOffered) {
  for (const char* rule : {"nearest", "right_hand", "random"}) EXPECT_FALSE(choose(rule));
}

TEST_F(AChoice, OfTheNearestDoesNotKeepToATarget) {
  stub_at(9.0, 0.0);
  stub_at(0.0, 5.0);
  EXPECT_EQ(choose("nearest"), 1);
  EXPECT_EQ(choose("nearest", 0), 1);
}

TEST_F(AChoice, ByTheRightHandTurnsWithTheBody) {
  stub_at(0.0, 5.0);
  stub_at(9.0, 0.0);
  stub_at(0.0, -14.0);
  stub_at(-1.0, -30.0);  // not near
  EXPECT_EQ(choose("right_hand"), 2);
  EXPECT_EQ(choose("right_hand", kNone, -3.0), 0);  // facing back, left is right
  EXPECT_EQ(choose("right_hand", 1), 1);            // the target, while it is on offer
}

TEST_F(AChoice, ByTheRightHandIsTheNearestWhereNoneIsNear) {
  stub_at(40.0, 0.0);
  stub_at(0.0, -50.0);
  EXPECT_EQ(choose("right_hand"), 0);
}

TEST_F(AChoice, AtRandomIsTheSameTwiceAndAnyOverMany) {
  std::set<int> chosen;
  for (int n = 0; n < 60; ++n) {
    stub_at(n, 1.0);
    const auto choice = choose("random");
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice, choose("random"));
    EXPECT_EQ(choose("random", 0), 0);
    chosen.insert(*choice);
  }
  // Of 60 choices of one in n, each new stub is met at most once; a third at least are others.
  EXPECT_GT(chosen.size(), 20U);
}

TEST_F(AChoice, ByARuleThatNobodyKnowsIsRefused) {
  stub_at(1.0, 0.0);
  EXPECT_THROW(static_cast<void>(choose("left_hand")), std::invalid_argument);
}

}  // namespace
}  // namespace adit
