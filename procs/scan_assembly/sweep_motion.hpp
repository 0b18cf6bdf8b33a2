// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/config/bounds.hpp"
#include "common/sensing/laser_tilt.hpp"

namespace adit {

struct SweepMotionParams {
  double from_rad = -0.5;            ///< start angle; positive is down
  double to_rad = 0.5;               ///< end angle
  double rate_rad_s = 0.156;         ///< of the sweep: 240 lines of an LMS-200, 0.24° apart
  double approach_rate_rad_s = 0.5;  ///< to the start and back to level
  double arrived_rad = 0.005;        ///< maximum error of a laser that stands at its goal

  template <class V>
  void visit(V& v) {
    v("from_rad", from_rad, within(-1.5, 1.5));
    v("to_rad", to_rad, within(-1.5, 1.5));
    v("rate_rad_s", rate_rad_s, above(0.0));
    v("approach_rate_rad_s", approach_rate_rad_s, above(0.0));
    v("arrived_rad", arrived_rad, above(0.0));
  }
};

/// The tilt motion of a sweep: to its start, to its end, back to level. A command is repeated each
/// second until the laser has arrived, as it may be lost.
class SweepMotion {
 public:
  enum class Phase { kIdle, kApproach, kSweep, kReturn };

  explicit SweepMotion(const SweepMotionParams& params) : params_(params) {}

  void begin() { enter(Phase::kApproach); }
  /// Returns to level from any angle.
  void return_to_level() { enter(Phase::kReturn); }
  void stop() { enter(Phase::kIdle); }

  /// Readings in order of time.
  void add(const TiltReading& reading);
  /// Enters the next phase when the laser has arrived. Returns the command to send now. `utime` is
  /// bus time.
  std::optional<TiltCommand> advance(std::int64_t utime);

  [[nodiscard]] Phase phase() const { return phase_; }
  /// Duration of the motions, with an approach from any angle of the sweep.
  [[nodiscard]] double duration_s() const;

 private:
  void enter(Phase phase);
  [[nodiscard]] double goal_rad() const;
  [[nodiscard]] bool arrived() const;

  SweepMotionParams params_;
  Phase phase_ = Phase::kIdle;
  std::optional<double> last_rad_, before_last_rad_;  ///< of this phase
  std::optional<std::int64_t> command_utime_;         ///< of the last command in this phase
};

}  // namespace adit
