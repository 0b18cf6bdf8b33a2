// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>

#include "common/geometry/pose2.hpp"

namespace adit {

/// How poses depart from the truth, beside coming late.
struct PoseNoise {
  double white_m = 0.02;  ///< of each pose, x and y each
  double white_rad = 0.0087;
  double slow_m = 0.02;  ///< varying over `slow_s`
  double slow_rad = 0.0087;
  double slow_s = 5.0;
  std::int64_t delay_us = 30'000;

  /// None but the delay.
  static PoseNoise none() { return {0.0, 0.0, 0.0, 0.0, 5.0, 30'000}; }
};

/// Poses as scan matching might give them: at the rate of an LMS-200 at half a degree, late and
/// with noise.
class LatePoses {
 public:
  LatePoses(const PoseNoise& noise, std::uint64_t seed);

  /// To be told the truth at each step of time.
  void see(std::int64_t utime, const Pose2& T_odom_body);
  /// Those that have come by now, in order.
  void deliver(std::int64_t utime,
               const std::function<void(std::int64_t utime, const Pose2& T_odom_body)>& take);

 private:
  struct Seen {
    std::int64_t utime;
    Pose2 T_odom_body;
  };

  PoseNoise noise_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::array<double, 3> slow_{};  ///< standard normal
  std::int64_t next_utime_ = 0;
  std::deque<Seen> waiting_;
};

}  // namespace adit
