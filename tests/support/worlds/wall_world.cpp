// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/wall_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "common/sensing/laser_mount.hpp"
#include "sim/mesh/mesh_builder.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"

namespace adit::test {
namespace {

constexpr double kWallHeightM = 2.0;
constexpr double kLaserHeightM = 0.62;  // of Groundhog

World world_of(const std::vector<Segment>& walls) {
  MeshBuilder builder;
  builder.begin_part(PartKind::kWall, Material::kRock, "walls");
  const auto vertex = [&](const Eigen::Vector2d& p, double z) {
    return builder.vertex(Eigen::Vector3d(p.x(), p.y(), z).cast<float>());
  };
  for (const auto& [a, b] : walls) {
    builder.quad(vertex(a, 0.0), vertex(b, 0.0), vertex(b, kWallHeightM), vertex(a, kWallHeightM));
  }
  World world;
  world.mesh = builder.take();
  return world;
}

double distance_m(const Eigen::Vector2d& p, const Segment& wall) {
  const Eigen::Vector2d along = wall.b - wall.a;
  const double share = std::clamp((p - wall.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - wall.a - share * along).norm();
}

Ray level_ray(const Eigen::Vector2d& p_world, double z_m, double angle_rad) {
  const Eigen::Vector3d origin(p_world.x(), p_world.y(), z_m);
  const Eigen::Vector3d direction(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  return {origin.cast<float>(), direction.cast<float>()};
}

}  // namespace

void add_closed(std::vector<Segment>& walls, const std::vector<Eigen::Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
}

WallWorld::WallWorld(std::vector<Segment> walls) : WallWorld(world_of(walls), kLaserHeightM) {
  walls_ = std::move(walls);
}

WallWorld::WallWorld(World world, double laser_z_m)
    : site_(std::make_shared<const Site>(std::move(world))), laser_z_m_(laser_z_m) {}

std::optional<double> WallWorld::cast(const Eigen::Vector2d& p_world, double angle_rad,
                                      double range_max_m) const {
  const auto hit =
      scene().cast(level_ray(p_world, laser_z_m_, angle_rad), static_cast<float>(range_max_m));
  if (!hit) return std::nullopt;
  return hit->distance_m;
}

std::optional<double> WallWorld::clearance(const Eigen::Vector2d& p_world, double radius_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Segment& wall : walls_) nearest_m = std::min(nearest_m, distance_m(p_world, wall));
  if (nearest_m > radius_m) return std::nullopt;
  return nearest_m;
}

LaserParams level_laser_params() {
  LaserParams params;
  params.beams = 181;
  params.offset_max_m = 0.0;
  return params;
}

LaserScan LevelLaser::measure(const Pose2& T_world_laser, std::int64_t utime) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(T_world_laser.x, T_world_laser.y, world_.laser_z_m());
  T.linear() = Eigen::AngleAxisd(T_world_laser.theta, Eigen::Vector3d::UnitZ()).matrix();
  return laser_->measure([&](double) { return T; }, utime);
}

LaserScan exact_scan(const WallWorld& world, const Pose2& T_world_laser, std::int64_t utime,
                     double range_max_m) {
  constexpr int kBeams = 181;
  constexpr double kNoReturnM = 81.91;
  LaserScan scan{utime, {}, -std::numbers::pi / 2.0, std::numbers::pi / (kBeams - 1)};
  for (int i = 0; i < kBeams; ++i) {
    const double angle = T_world_laser.theta + scan.angle_min_rad + i * scan.angle_step_rad;
    const auto range = world.cast(T_world_laser.translation(), angle, range_max_m);
    scan.ranges_m.push_back(static_cast<float>(range.value_or(kNoReturnM)));
  }
  return scan;
}

WallWorld straight_tunnel(double length_m, double width_m) {
  const double x = length_m / 2.0;
  const double y = width_m / 2.0;
  return WallWorld({{{-x, y}, {x, y}}, {{-x, -y}, {x, -y}}});
}

WallWorld sample_mine(int seed) { return {build_world(find_world("sample", seed)), kLaserHeightM}; }

WallWorld crooked_room() {
  std::vector<Segment> walls;
  add_closed(walls, {{-6, -3}, {2, -4}, {7, -1}, {6, 4}, {1, 3}, {0, 5}, {-5, 4}});
  add_closed(walls, {{2, 0}, {2.6, 0.2}, {2.4, 0.8}, {1.8, 0.6}});
  return WallWorld(walls);
}

std::vector<SurfacePoint> scan_points(const LaserScan& scan) {
  return surface_points(scan, LaserMount{}, SurfaceParams{});
}

std::vector<SurfacePoint> scan_points(const WallWorld& world, const Pose2& T_world_body) {
  return scan_points(exact_scan(world, T_world_body, 1'000'000));
}

}  // namespace adit::test
