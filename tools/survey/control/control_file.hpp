// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A point with known grid coordinates, and where the mission saw it.
struct ControlRow {
  enum class Place : std::uint8_t {
    kStart,  ///< the robot at its first scan; offsets are in its frame, on the ground
    kTime,   ///< the robot at a time
    kScan,   ///< a point in a 3D scan, in its frame "level"
    kMap,    ///< a point in the local grid of the mission, as a survey without control shows it
  };

  std::string name;
  std::optional<Eigen::Vector2d> plan;  ///< easting, northing [m]
  std::optional<double> elevation_m;
  Place place = Place::kStart;
  std::int64_t utime = 0;                 ///< of kTime [µs since the epoch]
  int scan = 0;                           ///< of kScan, from 1
  Eigen::Vector3d offset{0.0, 0.0, 0.0};  ///< in the frame of the place [m]
  double sd_m = 0.02;                     ///< of its coordinates, and of finding it
  int line = 0;                           ///< of the file, from 1
};

/// Reads control points: comma-separated values with the columns name, easting_m, northing_m,
/// elevation_m, place, x_m, y_m, z_m and sd_m, in any order; the first line names them. `place` is
/// "start", "time SECONDS", "scan NUMBER" or "map". A level has no easting and northing, a point in
/// plan no elevation. Throws std::runtime_error with `name:line: reason`, also for points that are
/// given twice.
std::vector<ControlRow> parse_control(std::string_view text, const std::string& name);
std::vector<ControlRow> read_control(const std::filesystem::path& path);

}  // namespace adit
