// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/cloud_registration.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/worlds/rock_sweep.hpp"

namespace adit {
namespace {

using test::pose;
using test::Rock;
using test::rough_ramp;
using test::rough_tunnel;
using test::smooth_tunnel;
using test::sweep;

double turn_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

struct Motion {
  Rock rock;
  Eigen::Isometry3d truth;
};

class CloudRegistrationRecovers : public testing::TestWithParam<Motion> {};

TEST_P(CloudRegistrationRecovers, AKnownMotionInSixDegreesOfFreedom) {
  const auto& [rock, truth] = GetParam();
  const CloudRegistrationParams params;
  const RegistrationCloud target(sweep(rock, Eigen::Isometry3d::Identity(), 1), params);
  const RegistrationCloud source(sweep(rock, truth, 2), params);
  CloudPrior prior;
  prior.T_target_source = truth * pose(0.15, -0.1, 0.1, 0.02, -0.03, 0.02);
  const CloudRegistration result = register_clouds(source, target, prior, params);
  ASSERT_TRUE(result.accepted);
  EXPECT_TRUE(result.degenerate.empty());
  // The bumps are sampled at 0.2 m, a tenth of their wavelength.
  const Eigen::Isometry3d error = truth.inverse() * result.T_target_source;
  EXPECT_LT(error.translation().norm(), 0.03);
  EXPECT_LT(std::abs(error.translation().z()), 0.015);
  EXPECT_LT(turn_between(truth, result.T_target_source), 0.005);
  Vector6d e;
  const Eigen::AngleAxisd turn(error.linear());
  e << error.translation(), turn.angle() * turn.axis();
  EXPECT_LT(e.dot(result.information * e), 22.5);  // 99.9 % of chi squared with 6 degrees
}

INSTANTIATE_TEST_SUITE_P(Motions, CloudRegistrationRecovers,
                         testing::Values(Motion{rough_tunnel, pose(2.0, 0.1, 0.0, 0.0, 0.0, 0.05)},
                                         Motion{rough_tunnel,
                                                pose(4.0, 0.3, 0.0, 0.05, 0.05, -0.1)},
                                         Motion{rough_ramp, pose(2.0, 0.0, 0.0, 0.0, 0.0, 0.0)},
                                         Motion{rough_ramp, pose(3.5, 0.2, 0.0, 0.0, -0.15, 0.1)}));

TEST(CloudRegistration, InventsNoInformationAlongASmoothTunnel) {
  const CloudRegistrationParams params;
  const Eigen::Isometry3d truth = pose(3.0, 0.2, 0.0, 0.0, 0.0, 0.05);
  const RegistrationCloud target(sweep(smooth_tunnel, Eigen::Isometry3d::Identity(), 1), params);
  const RegistrationCloud source(sweep(smooth_tunnel, truth, 2), params);
  CloudPrior prior;
  prior.T_target_source = pose(0.3, 0.0, 0.0, 0.0, 0.0, 0.0) * truth;
  const CloudRegistration result = register_clouds(source, target, prior, params);
  ASSERT_TRUE(result.converged);
  ASSERT_EQ(result.degenerate.size(), 1U);
  const Eigen::Vector3d axis =
      result.T_target_source.linear() * result.degenerate.front().head<3>();
  EXPECT_GT(std::abs(axis.x()), 0.98);
  const Matrix6d covariance = (result.information + Matrix6d::Identity()).inverse();
  EXPECT_GT(covariance(0, 0), 0.9);  // with a prior of 1 m²
  // All but the place along the axis is found, and that is left as it was.
  const Eigen::Isometry3d error = result.T_target_source * truth.inverse();
  EXPECT_LT(std::abs(error.translation().y()), 0.02);
  EXPECT_LT(std::abs(error.translation().z()), 0.02);
  EXPECT_NEAR(error.translation().x(), 0.3, 0.02);
  EXPECT_LT(turn_between(truth, result.T_target_source), 0.005);
}

/// What the farther scan sees of the common part is too sparse for surfaces.
TEST(CloudRegistration, FindsTheDistanceOfScansFarApart) {
  CloudRegistrationParams params;
  params.coarse_m = 0.3;
  params.fine_m = 0.1;
  params.range_max_m = 20.0;
  const Eigen::Isometry3d truth = pose(9.0, 0.2, 0.0, 0.0, 0.0, 0.03);
  const RegistrationCloud target(sweep(rough_tunnel, Eigen::Isometry3d::Identity(), 1), params);
  const RegistrationCloud source(sweep(rough_tunnel, truth, 2), params);
  CloudPrior prior;
  prior.T_target_source = pose(0.15, 0.0, 0.0, 0.0, 0.0, 0.0) * truth;
  prior.information.diagonal() << 25.0, 25.0, 400.0, 1e4, 1e4, 4e4;
  const CloudRegistration result = register_clouds(source, target, prior, params);
  ASSERT_TRUE(result.accepted);
  EXPECT_TRUE(result.degenerate.empty());
  const Eigen::Isometry3d error = result.T_target_source * truth.inverse();
  EXPECT_NEAR(error.translation().x(), 0.0, 0.02);
  EXPECT_NEAR(error.translation().y(), 0.0, 0.02);
}

TEST(CloudRegistration, RejectsScansWithoutOverlap) {
  const CloudRegistrationParams params;
  const RegistrationCloud target(sweep(rough_tunnel, Eigen::Isometry3d::Identity(), 1), params);
  const RegistrationCloud source(sweep(rough_tunnel, pose(60.0, 0.0, 0.0, 0.0, 0.0, 0.0), 2),
                                 params);
  CloudPrior prior;
  prior.T_target_source = pose(60.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  const CloudRegistration result = register_clouds(source, target, prior, params);
  EXPECT_FALSE(result.accepted);
  EXPECT_TRUE(result.information.isZero());
}

TEST(CloudRegistration, IsDeterministic) {
  const CloudRegistrationParams params;
  const Eigen::Isometry3d truth = pose(2.0, 0.1, 0.0, 0.0, 0.0, 0.05);
  const RegistrationCloud target(sweep(rough_tunnel, Eigen::Isometry3d::Identity(), 1), params);
  const RegistrationCloud source(sweep(rough_tunnel, truth, 2), params);
  CloudPrior prior;
  prior.T_target_source = truth;
  const CloudRegistration once = register_clouds(source, target, prior, params);
  const CloudRegistration again = register_clouds(source, target, prior, params);
  EXPECT_EQ(once.T_target_source.matrix(), again.T_target_source.matrix());
  EXPECT_EQ(once.information, again.information);
}

}  // namespace
}  // namespace adit
