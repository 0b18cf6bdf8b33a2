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

/// Interpolates at constant velocity in the frame of `a`; a motion along an arc for small steps.
inline Pose2 interpolate(const Pose2& T_w_a, const Pose2& T_w_b, double share) {
  const Pose2 step = between(T_w_a, T_w_b);
  return T_w_a * Pose2{share * step.x, share * step.y, share * step.theta};
}

/// Measurements by time, interpolated linearly.
template <class Value>
class InterpolationBuffer {
 public:
  /// In any order. False if there is a value of that time already, which is kept.
  bool add(std::int64_t utime, const Value& value) { return values_.emplace(utime, value).second; }

  void clear() { values_.clear(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  /// Time of the newest value; there must be one.
  [[nodiscard]] std::int64_t end_utime() const { return values_.rbegin()->first; }

  /// The interpolated value; the first or last one outside their times. Nothing without values.
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

/// Transforms beams to the frame level, each by the pose of the laser at its own time.
class BeamPlacement {
 public:
  /// The motion of the laser during the sweep. Both buffers must not be empty and must outlive this
  /// object. `R_level_body` levels the body at all its poses.
  struct Motion {
    const InterpolationBuffer<double>& tilt_rad;
    const InterpolationBuffer<Pose2>& T_odom_body;
    Pose2 T_odom_level;
    Eigen::Matrix3d R_level_body;
  };

  BeamPlacement(const LaserMount& mount, const ScanTiming& timing, const Motion& motion)
      : mount_(mount), timing_(timing), motion_(motion) {}

  /// `ranges_m` are those of the scan, in the convention of RangeImage.
  [[nodiscard]] CloudLine place(const LaserScan& scan, const std::vector<float>& ranges_m) const;

  /// Time of a beam, from 0 to n − 1 [µs since the epoch].
  [[nodiscard]] std::int64_t utime_of_beam(const LaserScan& scan, int beam) const;
  /// Time of the last beam of a scan.
  [[nodiscard]] std::int64_t end_utime(const LaserScan& scan) const;

 private:
  [[nodiscard]] Eigen::Isometry3d T_level_laser(std::int64_t utime) const;

  const LaserMount& mount_;
  const ScanTiming& timing_;
  Motion motion_;
};

}  // namespace adit
