// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_tilt.hpp"

namespace adit {

struct SweepMotionParams {
  double from_rad = -0.5;  ///< where it begins; positive looks down
  double to_rad = 0.5;
  double rate_rad_s = 0.156;         ///< of the sweep: a line for each 0.24°, 240 of an LMS-200
  double approach_rate_rad_s = 0.5;  ///< before and after
  double arrived_rad = 0.005;        ///< off its goal, at which a laser that stands has arrived

  template <class V>
  void visit(V& v) {
    v("from_rad", from_rad, within(-1.5, 1.5));
    v("to_rad", to_rad, within(-1.5, 1.5));
    v("rate_rad_s", rate_rad_s, above(0.0));
    v("approach_rate_rad_s", approach_rate_rad_s, above(0.0));
    v("arrived_rad", arrived_rad, above(0.0));
  }
};

/// Takes a laser through a sweep: to where it begins, through it, back to level. A command is
/// repeated while it is not fulfilled, for it may have been lost.
class SweepMotion {
 public:
  enum class Phase { kIdle, kApproach, kSweep, kReturn };

  explicit SweepMotion(const SweepMotionParams& params) : params_(params) {}

  void begin() { enter(Phase::kApproach); }
  /// From wherever it is, back to level.
  void return_to_level() { enter(Phase::kReturn); }
  void stop() { enter(Phase::kIdle); }

  /// In order of time.
  void add(const TiltReading& reading);
  /// `utime`: bus time. Goes on to the next phase where the laser has arrived; what is to be sent
  /// now.
  std::optional<TiltCommand> advance(std::int64_t utime);

  [[nodiscard]] Phase phase() const { return phase_; }
  /// How long the motions take, approach from anywhere in the sweep included.
  [[nodiscard]] double duration_s() const;

 private:
  void enter(Phase phase);
  [[nodiscard]] double goal_rad() const;
  [[nodiscard]] bool arrived() const;

  SweepMotionParams params_;
  Phase phase_ = Phase::kIdle;
  std::optional<double> last_rad_, before_last_rad_;  ///< readings of this phase
  std::optional<std::int64_t> command_utime_;         ///< of the last command of this phase
};

}  // namespace adit
