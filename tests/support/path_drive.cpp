// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/path_drive.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/in_plan.hpp"
#include "sim/vehicle/vehicle_model.hpp"
#include "tests/support/box_drift.hpp"
#include "tests/support/true_lateral_error.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kStepUs = 10'000;
constexpr std::int64_t kCommandUs = 50'000;
constexpr std::int64_t kStateUs = 100'000;
constexpr double kStepS = 1e-6 * static_cast<double>(kStepUs);
constexpr double kLongestS = 600.0;
constexpr double kLeftWithoutPosesS = 5.0;
constexpr double kScoreM = 0.02;
constexpr double kSwingM = 0.03;

/// Changes of side, of errors in order.
int swings(const std::vector<double>& errors_m) {
  int count = 0;
  double side = 0.0;
  for (const double error_m : errors_m) {
    if (std::abs(error_m) < kSwingM) continue;
    if (side * error_m < 0.0) ++count;
    side = error_m;
  }
  return count;
}

/// One drive, step by step.
class Run {
 public:
  Run(const PlannedPath& path, const PathDriveSetup& setup, const Site& site)
      : path_(path),
        setup_(setup),
        vehicle_(site, setup.driving.vehicle, setup.motion, setup.seed, kStart),
        poses_(setup.noise, setup.seed + 1'000'000),
        driving_(setup.driving),
        error_(path.points) {
    driving_.follow(path);
  }

  PathDrive drive() {
    while (!over()) step();
    const DrivingState& state = driving_.state();
    drive_.end = state.kind;
    drive_.reason = vehicle_.failure().value_or(state.reason);
    drive_.seconds = 1e-6 * static_cast<double>(utime_ - kStart);
    drive_.travelled_m = vehicle_.travelled_m();
    drive_.T_end_body = between(path_.points.back().T_odom_body, pose());
    if (rates_ > 0) drive_.steering_rms_1_m_s = std::sqrt(rate_squares_ / rates_);
    count_swings();
    return drive_;
  }

 private:
  void count_swings() {
    const auto metre = std::min<std::size_t>(drive_.lateral_m.size(), std::llround(1.0 / kScoreM));
    const double rest_m = static_cast<double>(drive_.lateral_m.size() - metre) * kScoreM;
    const std::vector<double> rest(drive_.lateral_m.begin() + static_cast<std::ptrdiff_t>(metre),
                                   drive_.lateral_m.end());
    if (rest_m > 0.0) drive_.swings_per_m = swings(rest) / rest_m;
  }

  [[nodiscard]] Pose2 pose() const { return in_plan(vehicle_.motion().T_world_body); }

  [[nodiscard]] bool over() const {
    using Kind = DrivingState::Kind;
    const Kind kind = driving_.state().kind;
    const bool ended =
        (kind == Kind::kArrived || kind == Kind::kFailed) && vehicle_.state().speed_m_s == 0.0;
    const double since_s = 1e-6 * static_cast<double>(utime_ - last_utime_);
    return ended || vehicle_.failure() || utime_ - kStart > std::llround(kLongestS * 1e6) ||
           (silent() && since_s > kLeftWithoutPosesS);
  }

  [[nodiscard]] bool silent() const { return vehicle_.travelled_m() >= setup_.poses_end_m; }

  void step() {
    if (!silent()) {
      poses_.see(utime_, pose());
      poses_.deliver(utime_, [this](std::int64_t utime, const Pose2& T_odom_body) {
        driving_.add_pose(utime, T_odom_body);
      });
      last_utime_ = utime_;
      silent_from_m_ = vehicle_.travelled_m();
      drive_.speed_then_m_s = vehicle_.state().speed_m_s;
    }
    if ((utime_ - kStart) % kStateUs == 0) driving_.add_state(vehicle_.state());
    if ((utime_ - kStart) % kCommandUs == 0) command();
    utime_ += kStepUs;
    vehicle_.advance(kStepS);
    drive_.without_poses_m = vehicle_.travelled_m() - silent_from_m_;
    if (vehicle_.travelled_m() < scored_m_ + kScoreM) return;
    scored_m_ += kScoreM;
    drive_.lateral_m.push_back(error_(pose().translation()));
  }

  void command() {
    const DriveCommand command = driving_.drive(utime_).command;
    const double rate = (command.curvature_1_m - curvature_1_m_) / (1e-6 * kCommandUs);
    if (command.speed_m_s != 0.0) {
      rate_squares_ += rate * rate;
      ++rates_;
    }
    curvature_1_m_ = command.curvature_1_m;
    vehicle_.command(command);
  }

  const PlannedPath& path_;
  const PathDriveSetup& setup_;
  VehicleModel vehicle_;
  LatePoses poses_;
  Driving driving_;
  TrueLateralError error_;
  PathDrive drive_;
  std::int64_t utime_ = kStart;
  std::int64_t last_utime_ = kStart;
  double silent_from_m_ = 0.0;
  double scored_m_ = 0.0;
  double curvature_1_m_ = 0.0;
  double rate_squares_ = 0.0;
  int rates_ = 0;
};

}  // namespace

PathDrive drive_path(const PlannedPath& path, const PathDriveSetup& setup) {
  static const Site site(box_drift({130.0, 130.0, 2.0}));
  return Run(path, setup, site).drive();
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  for (double& value : values) value = std::abs(value);
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace adit
