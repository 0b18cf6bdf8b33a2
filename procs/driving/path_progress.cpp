// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/path_progress.hpp"

#include <algorithm>
#include <utility>

namespace adit {

PathProgress::PathProgress(std::vector<PathRun> runs) : runs_(std::move(runs)) {}

void PathProgress::advance(const Pose2& T_odom_steered) {
  const double to_m = std::min(s_m_ + kLookM, run().length_m());
  s_m_ = run().nearest_m(T_odom_steered.translation(), s_m_, to_m);
}

bool PathProgress::begin_next_run() {
  if (run_ + 1 == runs_.size()) return false;
  driven_m_ += run().length_m();
  ++run_;
  s_m_ = 0.0;
  return true;
}

double PathProgress::remaining_m() const {
  double left_m = run_remaining_m();
  for (std::size_t i = run_ + 1; i < runs_.size(); ++i) left_m += runs_[i].length_m();
  return left_m;
}

TrackError PathProgress::error(const Pose2& T_odom_steered) const {
  const Pose2 T_path_steered = between(run().at(s_m_), T_odom_steered);
  return {T_path_steered.y, T_path_steered.theta};
}

double PathProgress::distance_m(const Pose2& T_odom_steered) const {
  return (run().at(s_m_).translation() - T_odom_steered.translation()).norm();
}

}  // namespace adit
