// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/drives/path_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/pose2.hpp"
#include "sim/vehicle/vehicle_model.hpp"
#include "tests/support/scores/cross_track_error.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

constexpr std::int64_t kPeriodUs = 26'667;

}  // namespace

DelayedNoisyPoses::DelayedNoisyPoses(const PoseNoise& noise, std::uint64_t seed)
    : noise_(noise), random_(seed) {
  for (double& slow : drift_) slow = normal_(random_);
}

void DelayedNoisyPoses::add_true_pose(std::int64_t utime, const Pose2& T_odom_body) {
  if (utime < next_utime_) return;
  next_utime_ = std::max(next_utime_, utime - kPeriodUs) + kPeriodUs;
  const double decay =
      std::exp(-1e-6 * static_cast<double>(kPeriodUs) / noise_.drift_time_constant_s);
  for (double& slow : drift_)
    slow = decay * slow + std::sqrt(1.0 - decay * decay) * normal_(random_);
  const auto with = [&](double value, std::size_t i, double white, double slow) {
    return value + white * normal_(random_) + slow * drift_[i];
  };
  const double x = with(T_odom_body.x, 0, noise_.white_m, noise_.drift_m);
  const double y = with(T_odom_body.y, 1, noise_.white_m, noise_.drift_m);
  const double theta = with(T_odom_body.theta, 2, noise_.white_rad, noise_.drift_rad);
  pending_.push_back({utime, {x, y, theta}});
}

void DelayedNoisyPoses::deliver(
    std::int64_t utime,
    const std::function<void(std::int64_t utime, const Pose2& T_odom_body)>& take) {
  while (!pending_.empty() && pending_.front().utime + noise_.delay_us <= utime) {
    take(pending_.front().utime, pending_.front().T_odom_body);
    pending_.pop_front();
  }
}

namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kStepUs = 10'000;
constexpr std::int64_t kCommandUs = 50'000;
constexpr std::int64_t kStateUs = 100'000;
constexpr double kStepS = 1e-6 * static_cast<double>(kStepUs);
constexpr double kTimeMaxS = 600.0;
constexpr double kTimeWithoutPosesMaxS = 5.0;
constexpr double kScoreM = 0.02;
constexpr double kOscillationM = 0.03;

/// Number of changes of side in a sequence of cross-track errors.
int oscillations(const std::vector<double>& errors_m) {
  int count = 0;
  double side = 0.0;
  for (const double error_m : errors_m) {
    if (std::abs(error_m) < kOscillationM) continue;
    if (side * error_m < 0.0) ++count;
    side = error_m;
  }
  return count;
}

/// Simulates one drive in steps of kStepUs.
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
    while (!finished()) step();
    const DrivingState& state = driving_.state();
    drive_.end = state.kind;
    drive_.reason = vehicle_.failure().value_or(state.reason);
    drive_.seconds = 1e-6 * static_cast<double>(utime_ - kStart);
    drive_.distance_travelled_m = vehicle_.distance_travelled_m();
    drive_.T_end_body = between(path_.points.back().T_odom_body, pose());
    if (rates_ > 0) drive_.steering_rms_1_m_s = std::sqrt(rate_squares_ / rates_);
    count_oscillations();
    return drive_;
  }

 private:
  void count_oscillations() {
    const auto metre =
        std::min<std::size_t>(drive_.cross_track_error_m.size(), std::llround(1.0 / kScoreM));
    const double rest_m = static_cast<double>(drive_.cross_track_error_m.size() - metre) * kScoreM;
    const std::vector<double> rest(
        drive_.cross_track_error_m.begin() + static_cast<std::ptrdiff_t>(metre),
        drive_.cross_track_error_m.end());
    if (rest_m > 0.0) drive_.oscillations_per_m = oscillations(rest) / rest_m;
  }

  [[nodiscard]] Pose2 pose() const { return in_plan(vehicle_.motion().T_world_body); }

  [[nodiscard]] bool finished() const {
    using Kind = DrivingState::Kind;
    const Kind kind = driving_.state().kind;
    const bool ended =
        (kind == Kind::kArrived || kind == Kind::kFailed) && vehicle_.state().speed_m_s == 0.0;
    const double since_s = 1e-6 * static_cast<double>(utime_ - last_utime_);
    return ended || vehicle_.failure() || utime_ - kStart > std::llround(kTimeMaxS * 1e6) ||
           (stale() && since_s > kTimeWithoutPosesMaxS);
  }

  [[nodiscard]] bool stale() const { return vehicle_.distance_travelled_m() >= setup_.poses_end_m; }

  void step() {
    if (!stale()) {
      poses_.add_true_pose(utime_, pose());
      poses_.deliver(utime_, [this](std::int64_t utime, const Pose2& T_odom_body) {
        driving_.add_pose(utime, T_odom_body);
      });
      last_utime_ = utime_;
      stale_from_m_ = vehicle_.distance_travelled_m();
      drive_.speed_at_last_pose_m_s = vehicle_.state().speed_m_s;
    }
    if ((utime_ - kStart) % kStateUs == 0) driving_.add_state(vehicle_.state());
    if ((utime_ - kStart) % kCommandUs == 0) command();
    utime_ += kStepUs;
    vehicle_.advance(kStepS);
    drive_.distance_without_poses_m = vehicle_.distance_travelled_m() - stale_from_m_;
    if (vehicle_.distance_travelled_m() < scored_m_ + kScoreM) return;
    scored_m_ += kScoreM;
    drive_.cross_track_error_m.push_back(error_(pose().translation()));
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
  DelayedNoisyPoses poses_;
  Driving driving_;
  CrossTrackError error_;
  PathDrive drive_;
  std::int64_t utime_ = kStart;
  std::int64_t last_utime_ = kStart;
  double stale_from_m_ = 0.0;
  double scored_m_ = 0.0;
  double curvature_1_m_ = 0.0;
  double rate_squares_ = 0.0;
  int rates_ = 0;
};

}  // namespace

PathDrive drive_path(const PlannedPath& path, const PathDriveSetup& setup) {
  static const Site site(box_tunnel({130.0, 130.0, 2.0}));
  return Run(path, setup, site).drive();
}

double absolute_quantile(std::vector<double> values, double share) {
  for (double& value : values) value = std::abs(value);
  return quantile(std::move(values), share);
}

}  // namespace adit
