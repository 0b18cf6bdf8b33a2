// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/geometry/pose2.hpp"

namespace adit {

/// The traversed path of the body in odom, sampled, as far back as odom is accurate enough.
class DrivenPath {
 public:
  struct Place {
    Pose2 T_odom_body;
    double distance_travelled_m;  ///< driven up to it [m]
    std::int64_t utime;
  };

  DrivenPath(double path_length_max_m, double speed_max_m_s)
      : path_length_max_m_(path_length_max_m), speed_max_m_s_(speed_max_m_s) {}

  /// Adds a pose. Returns false if the body cannot have driven that far in the time: a new odom
  /// frame has begun, and the path is reset until `anchor`.
  bool add(std::int64_t utime, const Pose2& T_odom_body);
  /// A new odom frame has begun at this time, with or without a jump. Returns false if `add` has
  /// detected it.
  bool reset(std::int64_t odom_epoch_utime);
  /// Sets the pose of the previous odom frame in the current one, and prepends the path in it.
  void anchor(const Pose2& T_odom_previous);

  /// Total distance travelled [m], without the noise at standstill.
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  /// Oldest first.
  [[nodiscard]] const std::deque<Place>& places() const { return places_; }

 private:
  [[nodiscard]] bool can_follow(std::int64_t utime, const Pose2& T_odom_body) const;

  double path_length_max_m_;
  double speed_max_m_s_;
  double distance_travelled_m_ = 0.0;
  std::deque<Place> places_;
  std::deque<Place> previous_;  ///< places in the previous odom frame
  struct Reading {
    std::int64_t utime;
    Pose2 T_odom_body;
  };
  std::optional<Reading> last_;
};

}  // namespace adit
