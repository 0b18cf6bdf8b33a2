// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// A laser with its name in the configuration.
struct NamedLaser {
  std::string name;  ///< "front"
  LaserMount mount;
};

/// The lasers that the vehicle has.
std::vector<NamedLaser> lasers_of(const Lasers& lasers);

/// Whether a laser looks over the body: its beams are within 12 cm of the highest point, which is
/// then usually the laser itself.
bool looks_over_body(const LaserMount& mount, const Vehicle& vehicle);

/// Length of a horizontal ray from the level laser inside the footprint, at a bearing in the body
/// frame [m]; 0 from outside if it does not enter.
double length_in_body_m(const LaserMount& mount, const Vehicle& vehicle, double bearing_rad);

/// Whether the level laser sees a point (body frame): within its field of view and beyond
/// range_min_m, and unless it looks over the body, not through more of it than the edge in which it
/// stands, range_min_m wide.
bool sees(const LaserMount& mount, const Vehicle& vehicle, const Eigen::Vector2d& p_body);

/// A part of the outline on which no laser sees what is near it, from one bearing (body frame, from
/// its origin) counter-clockwise to another [rad].
struct BlindArc {
  double from_rad = 0.0;
  double to_rad = 0.0;
  [[nodiscard]] double middle_rad() const { return 0.5 * (from_rad + to_rad); }
};

/// Where no laser sees points at a distance outside the footprint, in order of bearing from −π.
std::vector<BlindArc> blind_arcs(const Lasers& lasers, const Vehicle& vehicle, double outside_m);

/// The point at a distance outside the footprint, at a bearing from the origin of the body.
Eigen::Vector2d beside_body(const Vehicle& vehicle, double bearing_rad, double outside_m);

}  // namespace adit
