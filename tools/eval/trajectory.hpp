// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/files/new_file.hpp"
#include "common/files/output_file.hpp"
#include "common/files/spool.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// Pose of the body at a time, in the frame of its trajectory.
struct TimedPose {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 pose;
  double z_m = 0.0;  ///< height; 0 in trajectories without heights

  [[nodiscard]] Eigen::Vector3d position() const { return {pose.x, pose.y, z_m}; }

  friend bool operator==(const TimedPose&, const TimedPose&) = default;
};

/// Strictly increasing times.
using Trajectory = std::vector<TimedPose>;

/// Interpolates between two poses (`share` 0: a, 1: b): position along the straight line, angle by
/// the shortest rotation.
Pose2 blend(const Pose2& a, const Pose2& b, double share);

/// The pose at a time, interpolated. Nothing more than a millisecond before the first or after the
/// last pose; within a millisecond, for stamps written with fewer digits, that pose.
std::optional<Pose2> interpolate(const Trajectory& trajectory, std::int64_t utime);
std::optional<Pose2> interpolate(const Spool<TimedPose>& trajectory, std::int64_t utime);
/// The same with its height.
std::optional<TimedPose> interpolate_in_space(const Trajectory& trajectory, std::int64_t utime);

/// Whether any pose has a height other than 0.
bool has_heights(const Trajectory& trajectory);

/// Sum of the distances between consecutive poses [m]. Includes jitter.
double path_length_m(const Trajectory& trajectory);

/// Distance travelled by a robot whose poses jitter [m]: sum of the distances between poses at
/// least `step_m` apart. Smaller jitter adds nothing. A straight line loses less than a step at its
/// end, an arc of radius R in steps of s the share s²/24R².
double distance_travelled_m(const Trajectory& trajectory, double step_m);
double distance_travelled_m(const Spool<TimedPose>& trajectory, double step_m);

/// Step for distance_travelled_m: above the jitter of scan matching, far below the radius of bends.
inline constexpr double kTravelStepM = 0.2;

/// The trajectory format of the TUM RGB-D benchmark: one line `time x y z qx qy qz qw` per pose, in
/// seconds, metres and a unit quaternion; `#` starts a comment. The number of digits is fixed, so
/// that the same trajectory gives the same bytes.
void write_tum(std::ostream& out, const Trajectory& trajectory);
/// Throws std::runtime_error with the path if the file cannot be written.
void write_tum(const std::filesystem::path& path, const Trajectory& trajectory);
/// The same, line by line, of a trajectory of any length; `with_heights`: of has_heights.
class TumWriter {
 public:
  TumWriter(const std::filesystem::path& path, bool with_heights);

  void add(const TimedPose& pose);
  /// The file has its name when this returns.
  void close();

 private:
  void flush();

  NewFile file_;
  OutputFile output_;
  bool with_heights_;
  std::string text_;
};

/// Reads position and yaw. A malformed line, or a time that does not increase, throws
/// std::runtime_error with `name:line: reason`.
Trajectory read_tum(std::istream& in, std::string_view name);
Trajectory read_tum(const std::filesystem::path& path);

}  // namespace adit
