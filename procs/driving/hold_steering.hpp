// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/sensing/seconds.hpp"

namespace adit {

/// The steering of a robot that the guard holds in a narrow passage. Each turn brings one corner of
/// the body nearer to a wall, straight motion brings none: the robot therefore goes straight on,
/// and returns to its path over `kReturnM`. If that does not release it, the nose may be at a wall:
/// after `kStraightS` it steers as before.
class HoldSteering {
 public:
  static constexpr double kReturnM = 0.3;
  static constexpr double kStraightS = 5.0;  ///< longer than the guard's hold of a stop that recurs

  /// A new path.
  void reset() { *this = {}; }

  /// `progress_m` is the distance travelled on the path.
  void update(std::int64_t utime, double progress_m, bool is_held) {
    if (!is_held) {
      held_since_.reset();
    } else {
      if (!held_since_) held_since_ = utime;
      held_at_m_ = progress_m;
    }
    const bool has_tried = held_since_ && seconds(utime - *held_since_) > kStraightS;
    share_ = has_tried || !held_at_m_ ? 1.0
                                      : std::clamp((progress_m - *held_at_m_) / kReturnM, 0.0, 1.0);
    is_near_hold_ = held_at_m_ && *held_at_m_ > 0.0 && progress_m < *held_at_m_ + kReturnM;
  }

  /// Of the curvature that the path asks for: 0 straight on, 1 all of it.
  [[nodiscard]] double share() const { return share_; }
  /// Whether what caused a hold on the path is still near; a hold before its begin does not count.
  [[nodiscard]] bool is_near_hold() const { return is_near_hold_; }

 private:
  std::optional<std::int64_t> held_since_;
  std::optional<double> held_at_m_;
  double share_ = 1.0;
  bool is_near_hold_ = false;
};

}  // namespace adit
