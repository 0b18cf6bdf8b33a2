// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Mapping of a drive along a tunnel with smooth walls and back, which only the wheels measure, with
// 3D scans of floor and roof where it began and where it ended.
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "common/pose_graph/map_correction.hpp"
#include "procs/mapping/mapping.hpp"
#include "tests/support/worlds/rock_sweep.hpp"
#include "tests/support/worlds/wall_world.hpp"
#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

test::WallWorld smooth_walls() {
  return test::WallWorld({{{-60.0, 2.0}, {60.0, 2.0}}, {{-60.0, -2.0}, {60.0, -2.0}}});
}

class DriveOutAndBack {
 public:
  explicit DriveOutAndBack(double out_m) {
    add();
    sweep();
    for (int i = 0; i < std::lround(out_m / kStepM); ++i) move(kStepM, kScaleOut);
    for (int i = 0; i < std::lround(out_m / kStepM); ++i) move(-kStepM, kScaleBack);
  }

  void sweep() {
    Cloud cloud =
        test::sweep(test::rough_tunnel, test::pose(x_m_, 0.0, 0.0, 0.0, 0.0, 0.0), ++sweeps_);
    cloud.utime = utime_;
    cloud.T_odom_level = {odom_m_, 0.0, 0.0};
    mapping_.add(cloud);
    add();
  }
  void rest() {
    for (int i = 0; i < 15; ++i) add();  // 3 s
  }
  [[nodiscard]] double sd_m() const {
    return position_sd_m(mapping_.correction()->body_covariance);
  }
  [[nodiscard]] double error_m() const {
    return std::abs((mapping_.correction()->T_map_odom * Pose2{odom_m_, 0.0, 0.0}).x - x_m_);
  }

 private:
  static constexpr std::int64_t kBegin = 1'600'000'000'000'000;
  static constexpr std::int64_t kScanUs = 200'000;
  static constexpr double kStepM = 0.1;
  /// Metres of the wheels per metre: 8 m out and back they differ by 0.16 m.
  static constexpr double kScaleOut = 1.03;
  static constexpr double kScaleBack = 1.01;

  void move(double step_m, double scale) {
    x_m_ += step_m;
    odom_m_ += scale * step_m;
    add();
  }
  void add() {
    const bool is_first = utime_ == kBegin;
    ScanMatch match;
    match.utime = utime_;
    match.odom_epoch_utime = kBegin;
    match.channel = test::kFront;
    match.status = is_first ? ScanMatch::Status::kFirstScan : ScanMatch::Status::kMatched;
    match.reference_utime = is_first ? 0 : utime_ - kScanUs;
    match.T_odom_body = {odom_m_, 0.0, 0.0};
    match.attitude = Attitude{};
    match.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kOdometry}};
    match.wheels_scale_sd = 0.03;
    mapping_.add(test::kFront, laser_.measure({x_m_, 0.0, 0.0}, utime_), match);
    utime_ += kScanUs;
  }

  Mapping mapping_{MappingParams{}};
  test::LevelLaser laser_{smooth_walls(), 1};
  std::int64_t utime_ = kBegin;
  double x_m_ = 0.0;     ///< of the body, the truth
  double odom_m_ = 0.0;  ///< by the wheels
  unsigned sweeps_ = 0;
};

TEST(RestAtHome, IsLocalisedByA3DScanWhereWallsAreSmooth) {
  DriveOutAndBack drive(8.0);
  drive.rest();
  const double driven_m = drive.sd_m();
  EXPECT_GT(driven_m, 0.1);
  EXPECT_GT(drive.error_m(), 0.1);
  drive.sweep();
  drive.rest();
  EXPECT_LT(drive.sd_m(), 0.05);
  EXPECT_LT(drive.error_m(), 2.448 * drive.sd_m());
}

}  // namespace
}  // namespace adit
