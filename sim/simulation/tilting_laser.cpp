// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/tilting_laser.hpp"

#include <algorithm>
#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

MotionHistory::BodyState between(const MotionHistory::BodyState& a,
                                 const MotionHistory::BodyState& b, double share) {
  MotionHistory::BodyState state;
  state.utime = a.utime + static_cast<std::int64_t>(share * static_cast<double>(b.utime - a.utime));
  const Eigen::Quaterniond from(a.T_world_body.linear());
  const Eigen::Quaterniond to(b.T_world_body.linear());
  state.T_world_body.linear() = from.slerp(share, to).toRotationMatrix();
  state.T_world_body.translation() =
      a.T_world_body.translation() +
      share * (b.T_world_body.translation() - a.T_world_body.translation());
  state.tilt_rad = a.tilt_rad + share * (b.tilt_rad - a.tilt_rad);
  return state;
}

}  // namespace

void MotionHistory::discard_before(std::int64_t utime) {
  while (states_.size() > 1 && states_[1].utime <= utime) states_.pop_front();
}

MotionHistory::BodyState MotionHistory::at(std::int64_t utime, double seconds) const {
  // Subtracts the integer times first, which keeps the fractions exact.
  const auto seconds_since = [&](const BodyState& state) {
    return static_cast<double>(utime - state.utime) * 1e-6 + seconds;
  };
  const auto after = std::find_if(states_.begin(), states_.end(), [&](const BodyState& state) {
    return seconds_since(state) < 0.0;
  });
  if (after == states_.begin()) return states_.front();
  const BodyState& before = *std::prev(after);
  if (after == states_.end()) return before;
  const double step_s = static_cast<double>(after->utime - before.utime) * 1e-6;
  return between(before, *after, seconds_since(before) / step_s);
}

ScanSchedule::ScanSchedule(const LaserParams& params, std::int64_t start_utime, double phase)
    : start_utime_(start_utime),
      phase_(phase),
      period_s_(params.timing.scan_period_s(params.angle_step_rad())),
      last_beam_s_(params.timing.last_beam_time_s(params.beams, params.angle_step_rad())),
      scan_decimation_(params.scan_decimation) {}

std::int64_t ScanSchedule::begin_utime() const {
  const double seconds = (phase_ + static_cast<double>(scan_)) * period_s_;
  return start_utime_ + std::llround(seconds * 1e6);
}

std::int64_t ScanSchedule::end_utime() const {
  return begin_utime() + static_cast<std::int64_t>(std::ceil(last_beam_s_ * 1e6));
}

TiltingLaser::TiltingLaser(const RayScene& scene, const Setup& setup, std::int64_t utime,
                           const Eigen::Isometry3d& T_world_body)
    : mount_(setup.mount),
      tilt_error_rad_(setup.error.tilt_rad),
      laser_(scene, setup.laser, setup.noise_seed),
      tilt_(setup.tilt),
      schedule_(setup.laser, utime, setup.phase),
      history_({utime, T_world_body, tilt_.angle_rad()}),
      scan_loss_(setup.laser.scan_loss),
      loss_random_(setup.loss_seed),
      utime_(utime) {
  mount_.T_body_laser.theta += setup.error.yaw_rad;
}

void TiltingLaser::advance(std::int64_t utime, const Eigen::Isometry3d& T_world_body) {
  tilt_.advance(seconds(utime - utime_));
  utime_ = utime;
  history_.add({utime, T_world_body, tilt_.angle_rad()});
}

std::vector<TiltingLaser::FinishedScan> TiltingLaser::finished_scans(const AliveAt& alive) {
  std::vector<FinishedScan> scans;
  for (; schedule_.end_utime() <= utime_; schedule_.advance()) {
    if (schedule_.is_selected() && !is_lost(alive))
      scans.push_back({schedule_.end_utime(), measure()});
  }
  history_.discard_before(schedule_.begin_utime());
  return scans;
}

bool TiltingLaser::is_lost(const AliveAt& alive) {
  const bool lost = std::uniform_real_distribution<double>()(loss_random_) < scan_loss_;
  return lost || !alive(schedule_.begin_utime()) || !alive(schedule_.end_utime());
}

LaserScan TiltingLaser::measure() {
  const std::int64_t begin = schedule_.begin_utime();
  const auto T_world_laser = [&](double seconds) {
    const MotionHistory::BodyState state = history_.at(begin, seconds);
    return state.T_world_body * tilted_laser(mount_, state.tilt_rad + tilt_error_rad_);
  };
  return laser_.measure(T_world_laser, begin);
}

}  // namespace adit
