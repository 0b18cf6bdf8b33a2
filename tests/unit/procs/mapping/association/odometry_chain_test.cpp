// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/odometry_chain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/association/ring_walk.hpp"

namespace adit {
namespace {

const Eigen::Vector3d kStepSd(0.02, 0.01, 0.003);
const Eigen::Vector3d kLoopClosureSd(0.03, 0.02, 0.004);

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A bend of 30 steps, each with its own covariance.
class BentChain : public testing::Test {
 protected:
  BentChain() {
    chain_.add_map({});
    for (int i = 0; i < 30; ++i) {
      Eigen::Matrix3d A;
      A << 1.0, 0.1 * i, 0.0, -0.2, 1.0, 0.3, 0.0, 0.1, 1.0;
      const Eigen::Matrix3d scaled = A * kStepSd.asDiagonal();
      steps_.push_back({{1.0, 0.02 * i, 0.1 - 0.004 * i}, scaled * scaled.transpose()});
      chain_.add_map(steps_.back());
    }
  }

  /// By a loop over the steps, each displaced by `moved`.
  template <class Moved>
  [[nodiscard]] Pose2 walk(int from, int to, const Moved& moved) const {
    Pose2 T;
    for (int k = std::min(from, to); k < std::max(from, to); ++k) {
      T = T * steps_[at(k)].T_from_to * moved(k);
    }
    return from < to ? T : T.inverse();
  }
  [[nodiscard]] Pose2 walk(int from, int to) const {
    return walk(from, to, [](int) { return Pose2{}; });
  }

  /// Numerical derivatives, step by step.
  [[nodiscard]] Eigen::Matrix3d walked_covariance(int from, int to) const {
    constexpr double kDelta = 1e-6;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (int k = std::min(from, to); k < std::max(from, to); ++k) {
      Eigen::Matrix3d J;
      for (int axis = 0; axis < 3; ++axis) {
        const Pose2 delta = Pose2::from_vector(kDelta * Eigen::Vector3d::Unit(axis));
        const Pose2 moved = walk(from, to, [&](int i) { return i == k ? delta : Pose2{}; });
        J.col(axis) = between(walk(from, to), moved).vector() / kDelta;
      }
      covariance += J * steps_[at(k)].covariance * J.transpose();
    }
    return covariance;
  }

  std::vector<UncertainPose> steps_;
  OdometryChain chain_;
};

TEST_F(BentChain, EqualsALoopOverTheSteps) {
  for (const auto& [from, to] : {std::pair{0, 30}, {3, 17}, {17, 3}, {29, 30}, {30, 0}}) {
    const UncertainPose found = chain_.between(from, to);
    EXPECT_LT(between(walk(from, to), found.T_from_to).vector().norm(), 1e-12);
    EXPECT_TRUE(found.covariance.isApprox(walked_covariance(from, to),
                                          1e-4));  // error of the numerical derivatives
  }
  EXPECT_TRUE(chain_.between(7, 7).covariance.isZero(1e-15));
}

TEST_F(BentChain, HasTheCovarianceOfRandomSamples) {
  constexpr int kDraws = 20000;
  test::Normal normal(1);
  for (const auto& [from, to] : {std::pair{2, 22}, {22, 2}}) {
    Eigen::Matrix3d drawn = Eigen::Matrix3d::Zero();
    for (int draw = 0; draw < kDraws; ++draw) {
      const Pose2 moved = walk(from, to, [&](int k) {
        const Eigen::Matrix3d L = steps_[at(k)].covariance.llt().matrixL();
        return Pose2::from_vector(L * normal.motion(Eigen::Vector3d::Ones()).vector());
      });
      const Eigen::Vector3d e = between(walk(from, to), moved).vector();
      drawn += e * e.transpose() / kDraws;
    }
    const Eigen::Matrix3d found = chain_.between(from, to).covariance;
    const Eigen::Vector3d sd = found.diagonal().cwiseSqrt();
    const Eigen::Matrix3d error = (drawn - found).cwiseQuotient(sd * sd.transpose());
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 0.05);  // 5 times √(2 / draws)
  }
}

TEST_F(BentChain, MeasuresItsLength) {
  double length = 0.0;
  for (int k = 0; k < 12; ++k) length += steps_[at(k)].T_from_to.translation().norm();
  EXPECT_NEAR(chain_.length_m(12), length, 1e-12);
  EXPECT_EQ(chain_.maps(), 31);
}

TEST(UncertainPose, InvertedTwiceIsTheSame) {
  const UncertainPose a{{1.0, -2.0, 0.7}, kStepSd.cwiseAbs2().asDiagonal()};
  const UncertainPose b = inverse(inverse(a));
  EXPECT_LT(between(a.T_from_to, b.T_from_to).vector().norm(), 1e-12);
  EXPECT_TRUE(b.covariance.isApprox(a.covariance, 1e-12));
}

TEST(UncertainPose, IsWideInDirectionsWithoutInformation) {
  PoseConstraint open;
  open.T_from_to = {4.0, 1.0, 0.2};
  open.information = Eigen::Vector3d(0.0, 400.0, 10000.0).asDiagonal();
  const UncertainPose found = measured_by(open);
  EXPECT_EQ(found.T_from_to, open.T_from_to);
  EXPECT_NEAR(std::sqrt(found.covariance(0, 0)), 30.0, 1e-9);
  EXPECT_NEAR(std::sqrt(found.covariance(1, 1)), 0.05, 1e-5);
  EXPECT_NEAR(std::sqrt(found.covariance(2, 2)), 0.01, 1e-5);
}

/// Chi-square with three degrees of freedom: mean 3, variance 6, 5 % above 7.815.
void expect_chi_square(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  double above = 0.0;
  for (const double value : values) {
    mean += value / n;
    above += value > 7.815 ? 1.0 / n : 0.0;
  }
  EXPECT_NEAR(mean, 3.0, 4.0 * std::sqrt(6.0 / n));
  EXPECT_NEAR(above, 0.05, 4.0 * std::sqrt(0.05 * 0.95 / n));
}

/// Thirty straight steps with a turn every ten; measurements and loop closures with the stated
/// noise.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : normal_(seed) {
    odometry.add_map({});
    truth_.emplace_back();
    for (int i = 0; i < 30; ++i) {
      const Pose2 step{1.0, 0.0, i % 10 == 9 ? 1.5 : 0.0};
      truth_.push_back(truth_.back() * step);
      odometry.add_map({step * normal_.motion(kStepSd), kStepSd.cwiseAbs2().asDiagonal()});
    }
  }

  PoseConstraint loop_closure(int from, int to) {
    const Pose2 T = between(truth_[at(from)], truth_[at(to)]);
    return {from, to, T * normal_.motion(kLoopClosureSd), test::information_of(kLoopClosureSd)};
  }

  OdometryChain odometry;

 private:
  test::Normal normal_;
  std::vector<Pose2> truth_;
};

TEST(CycleResidual, OfTwoCorrectLoopClosuresIsChiSquare) {
  std::vector<double> values;
  for (std::uint32_t seed = 1; seed <= 3000; ++seed) {
    Draw draw(seed);
    const PoseConstraint a = draw.loop_closure(2, 25);
    values.push_back(cycle_residual(draw.odometry, a, draw.loop_closure(8, 29)).disagreement);
  }
  expect_chi_square(values);
}

TEST(CycleResidual, OfACorrectLoopClosureAndTheOdometryIsChiSquare) {
  std::vector<double> values;
  for (std::uint32_t seed = 1; seed <= 3000; ++seed) {
    Draw draw(seed);
    values.push_back(cycle_residual(draw.odometry, draw.loop_closure(1, 28)).disagreement);
  }
  expect_chi_square(values);
}

TEST(CycleResidual, IsSymmetric) {
  Draw draw(1);
  const PoseConstraint a = draw.loop_closure(2, 25);
  const PoseConstraint b = draw.loop_closure(8, 29);
  // Residuals are in different frames: equal up to second order.
  EXPECT_NEAR(cycle_residual(draw.odometry, a, b).disagreement,
              cycle_residual(draw.odometry, b, a).disagreement, 0.1);
}

TEST(CycleResidual, GrowsWithTheErrorExceptAlongADegenerateDirection) {
  Draw draw(1);
  const PoseConstraint a = draw.loop_closure(2, 25);
  PoseConstraint b = draw.loop_closure(3, 26);
  const Pose2 right = b.T_from_to;
  b.T_from_to = right * Pose2{1.0, 0.0, 0.0};
  EXPECT_GT(cycle_residual(draw.odometry, a, b).disagreement, 100.0);
  b.information(0, 0) = 0.0;
  EXPECT_LT(cycle_residual(draw.odometry, a, b).disagreement, 12.0);  // 99 % of chi-square
  EXPECT_LT(cycle_residual(draw.odometry, b).disagreement, 12.0);
  b.T_from_to = right * Pose2{0.0, 1.0, 0.0};
  EXPECT_GT(cycle_residual(draw.odometry, a, b).disagreement, 100.0);
}

/// Residuals drawn all over a map of 20 m by 30 m and all headings: the share within the gate.
TEST(ChanceOfFit, IsTheShareOfRandomResidualsWithinTheGate) {
  constexpr int kDraws = 200000;
  constexpr double kGate = 9.0;
  Eigen::Matrix3d covariance;
  covariance << 0.5, 0.1, 0.02, 0.1, 0.3, 0.0, 0.02, 0.0, 0.05;
  const Eigen::Matrix3d information = covariance.inverse();
  std::mt19937 rng(1);
  const auto within = [&](double range) {
    return range * (static_cast<double>(rng()) / 4294967296.0 - 0.5);
  };
  int fits = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d e(within(20.0), within(30.0), within(2.0 * std::numbers::pi));
    fits += e.dot(information * e) < kGate ? 1 : 0;
  }
  const double share = static_cast<double>(fits) / kDraws;
  EXPECT_NEAR(chance_of_fit(covariance, kGate, 600.0), share, 5.0 * std::sqrt(share / kDraws));
  EXPECT_EQ(chance_of_fit(1e6 * covariance, kGate, 600.0), 1.0);
  EXPECT_EQ(chance_of_fit(covariance, kGate, 0.0), 1.0);
}

TEST(OdometryChain, KnowsTheAreaAroundAllMaps) {
  OdometryChain odometry;
  EXPECT_EQ(odometry.area_m2(), 0.0);
  odometry.add_map({});
  odometry.add_map({{3.0, 0.0, 0.5 * std::numbers::pi}, {}});
  EXPECT_EQ(odometry.area_m2(), 0.0);
  odometry.add_map({{2.0, 0.0, 0.0}, {}});
  EXPECT_NEAR(odometry.area_m2(), 6.0, 1e-12);
}

}  // namespace
}  // namespace adit
