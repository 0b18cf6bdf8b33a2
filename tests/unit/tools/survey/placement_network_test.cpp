// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/placement_network.hpp"

#include <cstddef>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kApartM = 4.0;
constexpr double kRegistrationSdM = 0.004;

Matrix6d diagonal(double place_sd_m, double turn_sd_rad) {
  Vector6d sd;
  sd << Eigen::Vector3d::Constant(place_sd_m), Eigen::Vector3d::Constant(turn_sd_rad);
  return sd.cwiseAbs2().asDiagonal();
}

/// Scans along x, all registered to where they are by their coordinates.
std::vector<ObservedPlacement> scans(std::size_t count) {
  std::vector<ObservedPlacement> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    all[i].laser = {kApartM * static_cast<double>(i), 0.0, 0.0};
    all[i].information = diagonal(kRegistrationSdM, 0.001).inverse();
    all[i].prior_information = diagonal(0.1, 0.02).inverse();
    all[i].step_covariance = diagonal(0.01, 0.003);
  }
  return all;
}

/// The same by all unknowns at once.
struct Solution {
  Eigen::VectorXd motions;
  Eigen::MatrixXd covariance;
};
Solution dense_solution(const std::vector<ObservedPlacement>& scans) {
  const auto n = static_cast<Eigen::Index>(6 * scans.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  const Matrix6d floor = diagonal(0.005, 0.001);  // of a registration
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    if (!scans[i].information.isZero()) {
      const Matrix6d registration = (scans[i].information.inverse() + floor).inverse();
      A.block<6, 6>(at, at) += registration;
      b.segment<6>(at) += registration * scans[i].registered;
    }
    A.block<6, 6>(at, at) += scans[i].prior_information;
    if (i == 0) continue;
    const Eigen::Vector3d d = scans[i].laser - scans[i - 1].laser;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, n);
    J.block<6, 6>(0, at).setIdentity();
    J.block<6, 6>(0, at - 6) = -Matrix6d::Identity();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      J.block<3, 1>(0, at - 3 + axis) = -Eigen::Vector3d::Unit(axis).cross(d);
    A += J.transpose() * scans[i].step_covariance.inverse() * J;
  }
  return {A.ldlt().solve(b), A.inverse()};
}

TEST(PlacementNetwork, IsTheLeastSquaresSolutionOfScansThatAgree) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<ObservedPlacement> observed = scans(9);
  for (std::size_t i = 0; i < observed.size(); ++i) {
    observed[i].laser += Eigen::Vector3d(noise(random), noise(random), noise(random));
    for (Eigen::Index k = 0; k < 6; ++k)
      observed[i].registered[k] = (k < 3 ? 0.004 : 0.0008) * noise(random);
  }
  observed[4].information.setZero();
  const auto adjusted = adjust_placements(observed);
  const Solution dense = dense_solution(observed);
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    EXPECT_EQ(adjusted[i].agrees, i != 4) << i;
    EXPECT_TRUE(adjusted[i].motion.isApprox(dense.motions.segment<6>(at), 1e-6)) << i;
    EXPECT_TRUE(adjusted[i].covariance.isApprox(dense.covariance.block<6, 6>(at, at), 1e-6)) << i;
  }
}

TEST(PlacementNetwork, HoldsScansThatFollowAWallByTheirNeighbours) {
  std::vector<ObservedPlacement> observed = scans(12);
  for (const std::size_t i : {5U, 6U, 7U}) observed[i].registered.y() = 0.09;
  const auto adjusted = adjust_placements(observed);
  for (std::size_t i = 0; i < observed.size(); ++i) {
    EXPECT_EQ(adjusted[i].agrees, i < 5 || i > 7) << i;
    EXPECT_LT(adjusted[i].motion.norm(), 1e-6) << i;
  }
  EXPECT_GT(adjusted[6].covariance(1, 1), adjusted[2].covariance(1, 1));
}

/// Surveys of two missions differ by their starts, and farther in by what they have drifted.
TEST(PlacementNetwork, FollowsADriftThatGrows) {
  std::vector<ObservedPlacement> observed = scans(20);
  const double turn_rad = 0.02;
  for (ObservedPlacement& scan : observed) {
    scan.registered << 0.1, 0.2 + turn_rad * scan.laser.x(), 0.05, 0.0, 0.0, turn_rad;
    scan.prior_information = diagonal(3.0, 0.1).inverse();
  }
  for (const std::size_t i : {9U, 10U}) observed[i].registered.y() -= 0.1;
  const auto adjusted = adjust_placements(observed);
  for (std::size_t i = 0; i < observed.size(); ++i) {
    EXPECT_EQ(adjusted[i].agrees, i != 9 && i != 10) << i;
    EXPECT_NEAR(adjusted[i].motion.y(), 0.2 + turn_rad * observed[i].laser.x(), 1e-3) << i;
  }
}

TEST(PlacementNetwork, HasNoOpinionOnASingleScan) {
  std::vector<ObservedPlacement> observed = scans(1);
  observed[0].registered.x() = 0.05;
  const auto adjusted = adjust_placements(observed);
  EXPECT_TRUE(adjusted[0].agrees);
  EXPECT_NEAR(adjusted[0].motion.x(), 0.05, 1e-3);
  EXPECT_TRUE(adjust_placements({}).empty());
}

}  // namespace
}  // namespace adit
