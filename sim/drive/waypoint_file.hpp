// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A place to pass, and how fast to go there.
struct Waypoint {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
  std::optional<double> speed_m_s;    ///< on the leg that ends here; the driver's own without

  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

/// Reads lines `x y` or `x y speed` [m, m/s], in world; what follows # is a comment. Throws
/// std::runtime_error, with file and line, for a file that cannot be read, a line that is none of
/// these, a speed that is not positive, or no waypoint at all.
std::vector<Waypoint> read_waypoints(const std::filesystem::path& path);

/// The drive through a built-in world (`sim/worlds/<world>_drive.txt`). Throws std::runtime_error
/// for a world without one.
std::vector<Waypoint> built_in_drive(const std::string& world);

}  // namespace adit
