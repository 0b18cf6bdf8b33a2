// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/types/cloud.hpp"

namespace adit {

inline double interpolate(double a, double b, double share) { return a + share * (b - a); }

/// At constant velocity in the frame of `a`, which for small steps is a motion along an arc.
inline Pose2 interpolate(const Pose2& T_w_a, const Pose2& T_w_b, double share) {
  const Pose2 step = between(T_w_a, T_w_b);
  return T_w_a * Pose2{share * step.x, share * step.y, share * step.theta};
}

/// What was measured at some times, and so what was between them.
template <class Value>
class InterpolationBuffer {
 public:
  /// In any order. False where there is one of that time already: it stays.
  bool add(std::int64_t utime, const Value& value) { return values_.emplace(utime, value).second; }

  void clear() { values_.clear(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  /// Of the newest; there must be one.
  [[nodiscard]] std::int64_t end_utime() const { return values_.rbegin()->first; }

  /// Between the neighbours in time; the nearest before the first and after the last. Nothing where
  /// there is none.
  [[nodiscard]] std::optional<Value> at(std::int64_t utime) const {
    if (values_.empty()) return std::nullopt;
    const auto after = values_.lower_bound(utime);
    if (after == values_.end()) return values_.rbegin()->second;
    if (after == values_.begin()) return after->second;
    const auto before = std::prev(after);
    const auto share = static_cast<double>(utime - before->first) /
                       static_cast<double>(after->first - before->first);
    return interpolate(before->second, after->second, share);
  }

 private:
  std::map<std::int64_t, Value> values_;
};

/// Places beams in level, each from where the laser was at its own time.
class BeamPlacement {
 public:
  /// Both tracks must have something in them, and outlive this. Where the body was, as it stands:
  /// `R_level_body` makes it level wherever it goes.
  struct Motion {
    const InterpolationBuffer<double>& tilt_rad;
    const InterpolationBuffer<Pose2>& T_odom_body;
    Pose2 T_odom_level;
    Eigen::Matrix3d R_level_body;
  };

  BeamPlacement(const LaserMount& mount, const ScanTiming& timing, const Motion& motion)
      : mount_(mount), timing_(timing), motion_(motion) {}

  /// `ranges_m` are those of the scan as RangeImage has them.
  [[nodiscard]] CloudLine place(const LaserScan& scan, const std::vector<float>& ranges_m) const;

  /// [µs since the epoch], of beams 0 to n − 1 of the scan.
  [[nodiscard]] std::int64_t utime_of_beam(const LaserScan& scan, int beam) const;
  /// When the last of its beams is measured.
  [[nodiscard]] std::int64_t end_utime(const LaserScan& scan) const;

 private:
  [[nodiscard]] Eigen::Isometry3d T_level_laser(std::int64_t utime) const;

  const LaserMount& mount_;
  const ScanTiming& timing_;
  Motion motion_;
};

}  // namespace adit
