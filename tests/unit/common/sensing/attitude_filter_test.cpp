// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/attitude_filter.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kGravity = 9.81;
constexpr std::int64_t kPeriodUs = 10'000;

/// A tilted body with an IMU at 100 Hz.
class TiltedBody {
 public:
  /// At rest, rotated by roll about x, then by pitch about y; positive is nose down.
  void stand(double roll, double pitch, double seconds) {
    const Eigen::Matrix3d R = rotation(roll, pitch);
    for (int i = 0; i < std::lround(seconds * 100.0); ++i) {
      read(kGravity * R.transpose() * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
    }
  }
  void read(const Eigen::Vector3d& force, const Eigen::Vector3d& turning) {
    at_us_ += kPeriodUs;
    attitude_.add({at_us_, turning, force}, at_us_);
  }

  [[nodiscard]] double roll() const { return roll_rad(*attitude_.up_body()); }
  [[nodiscard]] double pitch_up() const { return pitch_up_rad(*attitude_.up_body()); }
  [[nodiscard]] bool is_known() const { return attitude_.is_known(at_us_); }

 private:
  static Eigen::Matrix3d rotation(double roll, double pitch) {
    return (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }

  AttitudeFilter attitude_{AttitudeFilterParams{}};
  std::int64_t at_us_ = 0;
};

TEST(AttitudeFilter, MeasuresRollAndPitchAtRest) {
  TiltedBody body;
  body.stand(0.2, -0.1, 0.1);
  EXPECT_NEAR(body.roll(), 0.2, 1e-9);
  EXPECT_NEAR(body.pitch_up(), 0.1, 1e-9);
}

TEST(AttitudeFilter, FollowsARotationImmediately) {
  TiltedBody body;
  body.stand(0.0, 0.0, 1.0);
  // 0.5 s at 0.8 rad/s about x, with a force that is not gravity.
  for (int i = 0; i < 50; ++i) body.read({0.0, 0.0, 50.0}, {0.8, 0.0, 0.0});
  EXPECT_NEAR(body.roll(), 0.4, 1e-3);  // steps of 10 ms
}

TEST(AttitudeFilter, IgnoresABump) {
  TiltedBody body;
  body.stand(0.0, 0.0, 1.0);
  for (int i = 0; i < 20; ++i) body.read({25.0, 10.0, 30.0}, Eigen::Vector3d::Zero());
  EXPECT_EQ(body.roll(), 0.0);
  EXPECT_EQ(body.pitch_up(), 0.0);
}

TEST(AttitudeFilter, IsCorrectedByGravityWithItsTimeConstant) {
  TiltedBody body;
  body.stand(0.0, 0.0, 1.0);
  body.stand(0.3, 0.0, 1.0);                                     // not measured by the gyroscopes
  EXPECT_NEAR(body.roll(), 0.3 * (1.0 - std::exp(-1.0)), 0.01);  // normalisation and steps
  body.stand(0.3, 0.0, 9.0);
  EXPECT_NEAR(body.roll(), 0.3, 1e-3);
}

TEST(AttitudeFilter, IsUnknownAfterALongTimeWithoutGravity) {
  TiltedBody body;
  body.stand(0.1, 0.0, 1.0);
  for (int i = 0; i < 1000; ++i) body.read({0.0, 0.0, 1.0}, Eigen::Vector3d::Zero());
  EXPECT_TRUE(body.is_known());
  body.read({0.0, 0.0, 1.0}, Eigen::Vector3d::Zero());
  EXPECT_FALSE(body.is_known());
  body.stand(0.1, 0.0, 0.01);
  EXPECT_TRUE(body.is_known());
}

TEST(AttitudeFilter, IsUnknownAfterAnOverflow) {
  for (const double rate : {std::numeric_limits<double>::max(), 1e200}) {
    TiltedBody body;
    body.stand(0.1, 0.0, 1.0);
    body.read({0.0, 0.0, 50.0}, {rate, rate, -rate});
    EXPECT_TRUE(!body.is_known() || std::isfinite(body.roll())) << rate;
    body.stand(0.1, 0.0, 10.0);
    EXPECT_NEAR(body.roll(), 0.1, 1e-3);
  }
}

TEST(AttitudeFilter, StartsWithAReadingOfAboutGravity) {
  TiltedBody body;
  body.read({25.0, 10.0, 30.0}, Eigen::Vector3d::Zero());
  EXPECT_FALSE(body.is_known());
  body.stand(0.1, 0.0, 0.01);
  ASSERT_TRUE(body.is_known());
  EXPECT_NEAR(body.roll(), 0.1, 1e-9);
}

}  // namespace
}  // namespace adit
