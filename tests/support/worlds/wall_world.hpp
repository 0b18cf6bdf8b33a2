// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/registration/surface_points.hpp"
#include "common/sensing/laser_scan.hpp"
#include "sim/laser/laser_model.hpp"
#include "sim/world/world.hpp"

namespace adit::test {

/// A straight wall in the plan, frame `world` [m].
struct Segment {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

/// Adds the sides of a polygon.
void add_closed(std::vector<Segment>& walls, const std::vector<Eigen::Vector2d>& corners);

/// The section through a world at the height of a level laser. The simulator casts the rays. Copies
/// share the mesh.
class WallWorld {
 public:
  /// Vertical walls.
  explicit WallWorld(std::vector<Segment> walls);
  /// The section through a world at a height.
  WallWorld(World world, double laser_z_m);

  /// Distance to the first wall in a direction [rad]; nothing if none is within `range_max_m`.
  [[nodiscard]] std::optional<double> cast(const Eigen::Vector2d& p_world, double angle_rad,
                                           double range_max_m) const;
  /// Distance to the nearest of the vertical walls; nothing if none is within `radius_m`.
  [[nodiscard]] std::optional<double> clearance(const Eigen::Vector2d& p_world,
                                                double radius_m) const;

  [[nodiscard]] const RayScene& scene() const { return site_->scene(); }
  [[nodiscard]] double laser_z_m() const { return laser_z_m_; }

 private:
  std::shared_ptr<const Site> site_;
  std::vector<Segment> walls_;
  double laser_z_m_ = 0.0;
};

/// The simulated LMS-200 at 1°, without the systematic offset of a single device, so that tests may
/// compare with the truth.
LaserParams level_laser_params();

/// The simulator's laser, level and at rest in a WallWorld.
class LevelLaser {
 public:
  LevelLaser(const WallWorld& world, std::uint64_t seed,
             const LaserParams& params = level_laser_params())
      : world_(world), laser_(std::make_unique<LaserModel>(world_.scene(), params, seed)) {}

  LaserScan measure(const Pose2& T_world_laser, std::int64_t utime);

 private:
  WallWorld world_;                    // keeps the scene
  std::unique_ptr<LaserModel> laser_;  // a LaserModel cannot be assigned
};

/// The true ranges, 181 beams at 1°; 81.91 m if no wall is within `range_max_m`.
LaserScan exact_scan(const WallWorld& world, const Pose2& T_world_laser, std::int64_t utime,
                     double range_max_m = 80.0);

/// Two smooth walls along x, centred on the origin, open at both ends.
WallWorld straight_tunnel(double length_m, double width_m);

/// The built-in world `sample`, with the walls of a seed, at the height of a laser.
WallWorld sample_mine(int seed);

/// A closed, irregular room of about 13 m by 9 m with a pillar. No two walls are parallel, so that
/// a scan constrains all directions. The origin is inside.
WallWorld crooked_room();

/// The surface points of a scan whose laser is at the origin of the body.
std::vector<SurfacePoint> scan_points(const LaserScan& scan);
/// The surface points of an exact scan.
std::vector<SurfacePoint> scan_points(const WallWorld& world, const Pose2& T_world_body);

}  // namespace adit::test
