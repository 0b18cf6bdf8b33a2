// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/session_rivals.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kTolerance = 1e-12;

/// Local maps 0 to 2 of a session and 3 to 5 of the next one, 5 m apart along a tunnel.
class SessionRivals : public testing::Test {
 protected:
  SessionRivals() {
    for (int i = 0; i < 6; ++i) hypothesis_.T_map_local.push_back({5.0 * i, 0.0, 0.0});
    for (int i = 1; i < 6; ++i)
      problem_.chain.push_back({i - 1, i, {5.0, 0.0, 0.0}, Eigen::Matrix3d::Zero()});
  }

  /// Finds a map at its pose, and beside it along the tunnel at these distances, each with its
  /// log-likelihood. `sd_m`: along the tunnel.
  void find(int newer, int older, double log_likelihood,
            const std::vector<std::pair<double, double>>& beside = {}, double sd_m = 0.05) {
    const auto& at = hypothesis_.T_map_local;
    LoopClosure loop_closure;
    loop_closure.id = static_cast<int>(problem_.loop_closures.size());
    loop_closure.newer_map = newer;
    LoopClosureAlternative here;
    here.older_map = older;
    here.T_older_newer = between(at[as_index(older)], at[as_index(newer)]);
    here.information = Eigen::Vector3d(1.0 / (sd_m * sd_m), 1e4, 1e4).asDiagonal();
    here.log_likelihood = log_likelihood;
    loop_closure.alternatives.push_back(here);
    for (const auto& [distance_m, its_log_likelihood] : beside) {
      LoopClosureAlternative there = here;
      there.T_older_newer = here.T_older_newer * Pose2{distance_m, 0.0, 0.0};
      there.log_likelihood = its_log_likelihood;
      loop_closure.alternatives.push_back(there);
    }
    problem_.loop_closures.push_back(std::move(loop_closure));
    hypothesis_.chosen.push_back(0);
  }
  [[nodiscard]] std::vector<SessionRival> rivals() const {
    return session_rivals(problem_, hypothesis_, {0, 3});
  }

  AssociationProblem problem_;
  Hypothesis hypothesis_;
};

TEST_F(SessionRivals, AreNoneWhereASessionFitsAtOnePlace) {
  find(3, 1, 50.0);
  find(2, 0, 50.0, {{0.7, 49.0}});  // within the first session
  find(4, 3, 50.0, {{0.7, 49.0}});  // within the second
  EXPECT_TRUE(rivals().empty());
}

TEST_F(SessionRivals, AreAsProbableAsTheirLikelihoodSays) {
  find(3, 1, 50.0, {{0.7, 48.5}});
  const auto found = rivals();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 3);
  EXPECT_NEAR(found[0].shift.x, 0.7, kTolerance);
  EXPECT_NEAR(found[0].probability(), 1.0 / (1.0 + std::exp(1.5)), kTolerance);
  // 0.7 m with probability p: the second moment is p times 0.49 m².
  EXPECT_NEAR(moment_of(found[0], hypothesis_, 5)(0, 0), found[0].probability() * 0.49, kTolerance);
  EXPECT_EQ(moment_of(found[0], hypothesis_, 2).norm(), 0.0);
}

/// The robot was not moved by more than this while the computer was off.
TEST_F(SessionRivals, AreLessProbableFartherFromWhereTheSessionBeforeEnded) {
  problem_.chain[2].information = Eigen::Vector3d(1.0, 1.0, 4.0).asDiagonal();
  hypothesis_.T_map_local[3].x += 0.5;  // 0.5 m beyond the end; its rival 1.2 m, or before
  find(3, 1, 50.0, {{0.7, 50.0}, {-0.7, 50.0}});
  ASSERT_EQ(rivals().size(), 2U);
  EXPECT_NEAR(rivals()[0].log_odds, 0.5 * (1.2 * 1.2 - 0.5 * 0.5), kTolerance);
  EXPECT_NEAR(rivals()[1].log_odds, 0.5 * (0.2 * 0.2 - 0.5 * 0.5), kTolerance);
}

TEST_F(SessionRivals, AreOutsideOfAnInterval) {
  find(3, 1, 50.0, {{0.7, 45.5}});  // 1.1 %
  ASSERT_EQ(rivals().size(), 1U);
  EXPECT_EQ(moment_of(rivals()[0], hypothesis_, 5).norm(), 0.0);
}

TEST_F(SessionRivals, CountMatchesOfOneMapOnce) {
  find(3, 1, 50.0, {{0.7, 48.0}});
  find(3, 0, 40.0, {{0.72, 39.0}});
  ASSERT_EQ(rivals().size(), 1U);
  EXPECT_NEAR(rivals()[0].log_odds, 1.5, kTolerance);
}

TEST_F(SessionRivals, GainByMapsThatFitBetterThere) {
  find(3, 1, 50.0, {{0.7, 48.0}});
  find(4, 1, 60.0, {{0.65, 61.0}});
  find(5, 1, 60.0, {{0.75, 64.0}});
  ASSERT_EQ(rivals().size(), 1U);
  EXPECT_NEAR(rivals()[0].log_odds, 2.0 - 1.0 - 4.0, kTolerance);
  EXPECT_GT(rivals()[0].probability(), 0.9);
}

TEST_F(SessionRivals, LoseByMapsThatAreNotFoundThereAlthoughTheyCouldTell) {
  find(3, 1, 50.0, {{0.7, 48.0}});
  const double before = rivals()[0].log_odds;
  find(4, 1, 60.0, {}, 2.0);  // slides along the tunnel: cannot tell
  EXPECT_NEAR(rivals()[0].log_odds, before, kTolerance);
  find(5, 1, 60.0, {}, 0.05);
  EXPECT_GT(rivals()[0].log_odds, before + 1.0);
}

TEST_F(SessionRivals, AreDroppedOnceRefuted) {
  find(3, 1, 50.0, {{0.7, 48.0}});
  find(4, 1, 60.0, {{0.7, 50.0}});
  EXPECT_TRUE(rivals().empty());
}

TEST_F(SessionRivals, TurnWithTheMapThatTheyAreSeenFrom) {
  hypothesis_.T_map_local[5] = {20.0, 5.0, 0.5 * std::numbers::pi};  // around a corner
  find(3, 1, 50.0, {{0.7, 50.0}});
  const SessionRival rival = rivals()[0];
  const Eigen::Matrix3d moment = moment_of(rival, hypothesis_, 5);
  EXPECT_NEAR(moment(0, 0), 0.0, kTolerance);
  EXPECT_NEAR(moment(1, 1), 0.5 * 0.49, kTolerance);
  // Within the gate of a search.
  EXPECT_GT(3.0 * std::sqrt(spread_to(rival, hypothesis_, 5, 3.0)(1, 1)), 0.7);
}

}  // namespace
}  // namespace adit
