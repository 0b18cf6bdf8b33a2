// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A point to pass, and the speed of the leg to it.
struct Waypoint {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
  std::optional<double> speed_m_s;    ///< on the leg that ends here; the driver's default if empty

  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

/// Reads lines `x y` or `x y speed` [m, m/s], in world; # starts a comment. Throws
/// std::runtime_error with file and line for a file that cannot be read, a malformed line, a speed
/// that is not positive, or a file without waypoints.
std::vector<Waypoint> read_waypoints(const std::filesystem::path& path);

/// The drive through a built-in world (`sim/worlds/<world>_drive.txt`). Throws std::runtime_error
/// for a world without one.
std::vector<Waypoint> built_in_drive(const std::string& world);

}  // namespace adit
