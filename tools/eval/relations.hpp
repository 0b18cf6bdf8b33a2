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

/// The pose of the robot at a later time seen from its pose at an earlier one, verified by hand.
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

/// How well a trajectory agrees with relations: Kümmerle et al., "On measuring the accuracy of SLAM
/// algorithms", Autonomous Robots 2009, eq. 9 with translation and rotation apart. The errors of
/// neighbouring relations do not add up, so that one wrong turn costs what it is worth.
struct RelationsScore {
  std::size_t used = 0;
  std::size_t outside = 0;        ///< relations with a time that the trajectory does not cover
  ErrorStatistics translation_m;  ///< zero where none was used
  ErrorStatistics rotation_deg;   ///< of the absolute angle
};

/// Lines `t1 t2 dx dy dz droll dpitch dyaw` in seconds, metres and radians, of which the planar
/// part is read. A malformed line throws std::runtime_error with `name:line: reason`.
std::vector<Relation> read_relations(std::istream& in, std::string_view name);
std::vector<Relation> read_relations(const std::filesystem::path& path);

RelationsScore score_relations(const std::vector<Relation>& relations,
                               const Trajectory& trajectory);

/// A JSON object, over several lines.
std::string to_json(const RelationsScore& score);

}  // namespace adit
