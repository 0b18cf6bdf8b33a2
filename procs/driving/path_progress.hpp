// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/path/driving_state.hpp"
#include "procs/driving/path_run.hpp"

namespace adit {

/// How far along its path the robot is. Never goes back, and looks only a little ahead of where it
/// was, so that a path that crosses itself or turns back is driven in order.
class PathProgress {
 public:
  static constexpr double kLookM = 0.5;  ///< ahead, for the nearest place of the run

  /// At least one run.
  explicit PathProgress(std::vector<PathRun> runs);

  /// To the place of the run nearest to the robot.
  void advance(const Pose2& T_odom_steered);
  /// False where this is the last.
  bool begin_next_run();

  [[nodiscard]] const PathRun& run() const { return runs_[run_]; }
  /// On the run.
  [[nodiscard]] double s_m() const { return s_m_; }
  [[nodiscard]] double run_remaining_m() const { return run().length_m() - s_m_; }
  /// Of the whole path.
  [[nodiscard]] double done_m() const { return driven_m_ + s_m_; }
  [[nodiscard]] double remaining_m() const;
  [[nodiscard]] TrackError error(const Pose2& T_odom_steered) const;
  /// From the place on the run: more than the error beside it before its beginning, behind its end.
  [[nodiscard]] double distance_m(const Pose2& T_odom_steered) const;

 private:
  std::vector<PathRun> runs_;
  std::size_t run_ = 0;
  double s_m_ = 0.0;
  double driven_m_ = 0.0;  ///< of the runs before
};

}  // namespace adit
