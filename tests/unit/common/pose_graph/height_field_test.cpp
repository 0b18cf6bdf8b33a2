// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/height_field.hpp"

#include <cstddef>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPitchSd = 0.005;

/// A chain of climbs; node i + 1 is `climb_m` above node i.
std::vector<HeightConstraint> chain(int nodes, double climb_m, double sd_m, double forward_m) {
  std::vector<HeightConstraint> constraints;
  for (int i = 0; i + 1 < nodes; ++i) {
    constraints.push_back({i, i + 1, climb_m, sd_m, {{{0, forward_m}}}});
  }
  return constraints;
}

TEST(HeightField, AddsUpClimbs) {
  const HeightField field(5, chain(5, 0.25, 0.01, 0.0), kPitchSd);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(field.height_m(i), 0.25 * i, 1e-6);
    EXPECT_NEAR(field.variances_to(0)[i], 1e-4 * i, 1e-9);
    EXPECT_NEAR(field.variances_to(4)[i], 1e-4 * (4 - i), 1e-9);
  }
}

TEST(HeightField, ErrorOfThePitchAddsUpWithTheDistance) {
  const HeightField field(3, chain(3, 0.0, 0.01, 50.0), kPitchSd);
  EXPECT_NEAR(field.variances_to(0)[2], 2e-4 + 0.25, 1e-6);  // (100 m · 5 mrad)²
}

TEST(HeightField, ReturnToTheStartRevealsTheErrorOfThePitch) {
  constexpr double kError = 0.003;
  auto constraints = chain(9, 0.0, 1e-3, 10.0);
  for (HeightConstraint& climb : constraints) climb.climb_m = kError * climb.travels[0].forward_m;
  constraints.push_back({0, 8, 0.0, 1e-3, {}});  // the same ground
  const HeightField field(9, constraints, kPitchSd);
  EXPECT_NEAR(field.pitch_error_rad(0), kError, 1e-5);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(field.height_m(i), 0.0, 1e-3);
}

TEST(HeightField, CorrectsByWhatIsKnownOfThePitch) {
  constexpr double kError = 0.003;
  auto constraints = chain(9, 0.0, 1e-3, 10.0);
  for (HeightConstraint& climb : constraints) climb.climb_m = kError * climb.travels[0].forward_m;
  HeightField field(9, constraints, kPitchSd);
  const TiltPrior known{{kError, 0.0}, 1e-8 * Eigen::Matrix2d::Identity()};
  field.set_tilt_prior(0, known);
  field.update();
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(field.height_m(i), 0.0, 1e-6);
  EXPECT_NEAR(field.variance(0, 8), 8e-6 + 80.0 * 80.0 * 1e-8, 1e-9);

  HeightField known_before(kPitchSd);
  known_before.set_tilt_prior(0, known);
  for (int node = 1; node < 9; ++node) known_before.add_node();
  for (const HeightConstraint& climb : constraints) known_before.add(climb);
  known_before.update();
  EXPECT_NEAR(known_before.height_m(8), 0.0, 1e-6);
}

/// What is seen to the side of a body that rolls too much seems to be high.
TEST(HeightField, CorrectsByWhatIsKnownOfTheRoll) {
  const Eigen::Vector2d error(0.003, -0.004);
  const HeightConstraint seen{0, 1, 8.0 * error.x() + 2.0 * error.y(), 1e-3, {{{0, 8.0, 2.0}}}};
  HeightField field(2, {seen}, kPitchSd);
  field.set_tilt_prior(0, {error, 1e-10 * Eigen::Matrix2d::Identity()});
  field.update();
  EXPECT_NEAR(field.height_m(1), 0.0, 1e-6);
}

TEST(HeightField, NodesWithoutAConstraintAreUnknown) {
  const HeightField field(3, {{0, 1, 0.5, 0.01, {}}}, kPitchSd);
  EXPECT_NEAR(field.height_m(1), 0.5, 1e-6);
  EXPECT_NEAR(field.variances_to(0)[2], 1e6, 1.0);
  EXPECT_EQ(HeightField(kPitchSd).nodes(), 1);
  EXPECT_EQ(HeightField(kPitchSd).height_m(0), 0.0);
  EXPECT_EQ(HeightField(kPitchSd).variances_to(0).size(), 1);
}

/// Against the dense solution of the same least squares problem.
TEST(HeightField, AgreesWithDenseLeastSquares) {
  constexpr int kNodes = 12;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  auto constraints = chain(kNodes, 0.0, 0.02, 5.0);
  for (HeightConstraint& climb : constraints) {
    climb.climb_m = 0.1 * normal(random);
    climb.travels[0].session = climb.from < 6 ? 0 : 1;
  }
  constraints.push_back({2, 9, 0.1, 0.03, {{{0, 3.0, 1.5}, {1, -2.0, 4.0}}}});
  constraints.push_back({0, 11, -0.2, 0.03, {}});
  const HeightField field(kNodes, constraints, kPitchSd);

  constexpr int kUnknowns = kNodes - 1 + 4;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(kUnknowns);
  for (int i = 0; i < kUnknowns; ++i) information(i, i) = i < kNodes - 1 ? 1e-6 : 4e4;
  for (const HeightConstraint& constraint : constraints) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(kUnknowns);
    if (constraint.from > 0) row[constraint.from - 1] -= 1.0;
    if (constraint.to > 0) row[constraint.to - 1] += 1.0;
    for (const auto& [session, forward_m, left_m] : constraint.travels) {
      row[kNodes - 1 + session] += forward_m;
      row[kNodes + 1 + session] += left_m;
    }
    const double weight = 1.0 / (constraint.sd_m * constraint.sd_m);
    information += weight * row * row.transpose();
    b += weight * constraint.climb_m * row;
  }
  const Eigen::MatrixXd covariance = information.inverse();
  const Eigen::VectorXd solution = covariance * b;
  for (int i = 1; i < kNodes; ++i) {
    EXPECT_NEAR(field.height_m(i), solution[i - 1], 1e-9);
    EXPECT_NEAR(field.variances_to(0)[i], covariance(i - 1, i - 1), 1e-9);
    const double between = covariance(i - 1, i - 1) + covariance(4, 4) - 2.0 * covariance(i - 1, 4);
    EXPECT_NEAR(field.variances_to(5)[i], between, 1e-9);
  }
  EXPECT_NEAR(field.pitch_error_rad(0), solution[kNodes - 1], 1e-9);
  EXPECT_NEAR(field.pitch_error_rad(1), solution[kNodes], 1e-9);
}

TEST(HeightField, ThatChangedEqualsANewOne) {
  constexpr int kNodes = 40;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  HeightField field(kPitchSd);
  std::vector<HeightConstraint> climbs;
  std::vector<int> ids;
  const auto expect_equal = [&](const std::vector<HeightConstraint>& constraints) {
    field.update();
    const HeightField expected(field.nodes(), constraints, kPitchSd);
    for (int i = 0; i < field.nodes(); ++i) {
      EXPECT_NEAR(field.height_m(i), expected.height_m(i), 1e-6);
      EXPECT_NEAR(field.variance(0, i), expected.variance(0, i), 1e-8);
      EXPECT_NEAR(field.variance(i, field.nodes() / 2), expected.variance(i, field.nodes() / 2),
                  1e-8);
    }
    EXPECT_NEAR(field.pitch_error_rad(1), expected.pitch_error_rad(1), 1e-6);
  };
  const auto add = [&](const HeightConstraint& constraint) {
    climbs.push_back(constraint);
    ids.push_back(field.add(constraint));
  };
  for (int i = 1; i < kNodes; ++i) {
    field.add_node();
    add({i - 1, i, 0.1 * normal(random), 0.02, {{{i < 30 ? 0 : 1, 5.0}}}});
    if (i % 7 == 0) add({i / 2, i, 0.1 * normal(random), 0.03, {}});
    expect_equal(climbs);
  }
  for (int removed = 0; removed < 15; ++removed) {  // the second session too
    const int newest = field.nodes() - 1;
    for (std::size_t k = ids.size(); k-- > 0;) {
      if (climbs[k].to != newest) continue;
      field.remove(ids[k]);
      ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(k));
      climbs.erase(climbs.begin() + static_cast<std::ptrdiff_t>(k));
    }
    field.remove_newest_node();
    expect_equal(climbs);
  }
}

}  // namespace
}  // namespace adit
