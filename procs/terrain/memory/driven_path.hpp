// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/geometry/pose2.hpp"

namespace adit {

/// The way that the body has come, in odom: a pose for each piece of it, as far back as odom is
/// trusted.
class DrivenPath {
 public:
  struct Place {
    Pose2 T_odom_body;
    double distance_travelled_m;  ///< driven until there
    std::int64_t utime;
  };

  DrivenPath(double path_length_max_m, double speed_max_m_s)
      : path_length_max_m_(path_length_max_m), speed_max_m_s_(speed_max_m_s) {}

  /// False where nobody drives that far in the time: odom has begun anew, and so does the way,
  /// until the two are tied.
  bool add(std::int64_t utime, const Pose2& T_odom_body);
  /// Odom has begun anew then, whether it jumps or not. False where `add` has seen that.
  bool reset(std::int64_t odom_epoch_utime);
  /// Where the odom of before lies in this one: the way before leads on to where this one begins.
  void anchor(const Pose2& T_odom_previous);

  /// Driven in all [m]; what noise adds at rest is no way.
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  /// Oldest first.
  [[nodiscard]] const std::deque<Place>& places() const { return places_; }

 private:
  [[nodiscard]] bool can_follow(std::int64_t utime, const Pose2& T_odom_body) const;

  double path_length_max_m_;
  double speed_max_m_s_;
  double distance_travelled_m_ = 0.0;
  std::deque<Place> places_;
  std::deque<Place> previous_;  ///< places in the odom of before
  struct Reading {
    std::int64_t utime;
    Pose2 T_odom_body;
  };
  std::optional<Reading> last_;
};

}  // namespace adit
