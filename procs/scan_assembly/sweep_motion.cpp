// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/sweep_motion.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int64_t kRepeatPeriodUs = 1'000'000;
constexpr double kStoppedRad = 0.001;  // maximum change between readings of a standing laser

}  // namespace

void SweepMotion::add(const TiltReading& reading) {
  before_last_rad_ = last_rad_;
  last_rad_ = reading.angle_rad;
}

std::optional<TiltCommand> SweepMotion::advance(std::int64_t utime) {
  if (phase_ == Phase::kIdle) return std::nullopt;
  if (command_utime_ && arrived()) {
    if (phase_ == Phase::kReturn) {
      stop();
      return std::nullopt;
    }
    enter(phase_ == Phase::kApproach ? Phase::kSweep : Phase::kReturn);
  }
  if (command_utime_ && utime < *command_utime_ + kRepeatPeriodUs) return std::nullopt;
  command_utime_ = utime;
  const bool sweeps = phase_ == Phase::kSweep;
  return TiltCommand{utime, goal_rad(), sweeps ? params_.rate_rad_s : params_.approach_rate_rad_s};
}

double SweepMotion::duration_s() const {
  const double range = std::abs(params_.to_rad - params_.from_rad);
  const double approach = std::max(range, std::abs(params_.from_rad));
  return approach / params_.approach_rate_rad_s + range / params_.rate_rad_s;
}

void SweepMotion::enter(Phase phase) {
  phase_ = phase;
  last_rad_.reset();
  before_last_rad_.reset();
  command_utime_.reset();
}

double SweepMotion::goal_rad() const {
  if (phase_ == Phase::kApproach) return params_.from_rad;
  return phase_ == Phase::kSweep ? params_.to_rad : 0.0;
}

bool SweepMotion::arrived() const {
  if (!before_last_rad_) return false;
  return std::abs(*last_rad_ - goal_rad()) <= params_.arrived_rad &&
         std::abs(*last_rad_ - *before_last_rad_) <= kStoppedRad;
}

}  // namespace adit
