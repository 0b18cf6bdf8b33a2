// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "tools/eval/trajectory.hpp"

namespace adit {

/// Keeps a pose of a trajectory every 5 cm, 20 mrad or second, and wherever the straight line
/// between two kept ones would miss a pose by more than a tolerance, as where a body stops.
class ThinnedTrajectory {
 public:
  /// `tolerance_m`: in each coordinate; infinite for poses that jitter.
  explicit ThinnedTrajectory(double tolerance_m = std::numeric_limits<double>::infinity())
      : tolerance_m_(tolerance_m) {}

  /// Adds a pose; one that does not advance in time is ignored. The last pose is always kept.
  void add(const TimedPose& pose);

  [[nodiscard]] const Trajectory& poses() const { return poses_; }

 private:
  [[nodiscard]] bool is_on_line_to(const TimedPose& pose) const;

  double tolerance_m_;
  Trajectory poses_;
  Trajectory between_;  ///< left out between the last but one pose and the last
};

}  // namespace adit
