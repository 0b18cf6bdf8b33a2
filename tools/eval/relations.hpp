// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Relative pose of the robot between two times, verified by hand.
struct Relation {
  std::int64_t utime_1 = 0;  ///< [µs since the epoch]
  std::int64_t utime_2 = 0;  ///< [µs since the epoch]
  Pose2 T_1_2;
};

struct ErrorStatistics {
  double mean = 0.0;
  double standard_deviation = 0.0;
  double median = 0.0;
  double max = 0.0;
};

/// Error of a trajectory against relations: Kümmerle et al., "On measuring the accuracy of SLAM
/// algorithms", Autonomous Robots 2009, eq. 9, with translation and rotation apart. Relations are
/// independent, so that one wrong rotation does not affect all later errors.
struct RelationsScore {
  std::size_t used = 0;
  std::size_t outside = 0;        ///< relations with a time outside the trajectory
  ErrorStatistics translation_m;  ///< zero if no relation is used
  ErrorStatistics rotation_deg;   ///< of the absolute angle
};

/// Reads the planar part of lines `t1 t2 dx dy dz droll dpitch dyaw` in seconds, metres and
/// radians. A malformed line throws std::runtime_error with `name:line: reason`.
std::vector<Relation> read_relations(std::istream& in, std::string_view name);
std::vector<Relation> read_relations(const std::filesystem::path& path);

RelationsScore score_relations(const std::vector<Relation>& relations,
                               const Trajectory& trajectory);

/// A JSON object of several lines.
std::string to_json(const RelationsScore& score);

}  // namespace adit
