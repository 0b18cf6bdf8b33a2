// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/local_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "common/registration/surfel_map.hpp"

namespace adit {
namespace {

constexpr double kSameGroundM = 2.0;  // between two paths on one ground
constexpr double kAsNearM = 0.1;      // in addition to the distance of the nearest points

SurfacePoint to_point(const Surfel& surfel, double wall_variance) {
  SurfacePoint point;
  point.p = surfel.p;
  point.z_m = surfel.z_m;
  point.normal = surfel.normal;
  point.normal_variance = surfel.normal_variance;
  point.variance = surfel.variance + wall_variance;
  return point;
}

/// Whether the scan's view differs enough from the last stored one of its laser.
bool new_view(const Pose2& T_local_body, const Pose2& T_local_last,
              const LocalWallsParams& params) {
  const Pose2 moved = between(T_local_last, T_local_body);
  return moved.translation().norm() >= params.view_distance_m ||
         std::abs(moved.theta) >= params.view_angle_rad;
}

}  // namespace

LocalWalls local_walls(const LocalMap& map, const LaserMounts& mounts,
                       const LocalWallsParams& params) {
  LocalWalls walls;
  SurfelMapParams thinning;
  thinning.spacing_m = params.spacing_m;
  SurfelMap surfels(thinning, SurfelMap::Buckets::kOfOneLocalMap);
  std::map<std::string, Pose2> last_view;
  Pose2 T_local_last;
  double forward_m = 0.0;
  for (const LocalScan& local : map.scans) {
    forward_m += between(T_local_last, local.T_local_body).x;
    T_local_last = local.T_local_body;
    walls.path.push_back({{local.T_local_body.x, local.T_local_body.y, local.z_m}, forward_m});
    const auto mount = mounts.find(local.channel);
    if (mount == mounts.end()) continue;
    const Attitude attitude = local.attitude.value_or(Attitude{});
    auto points = surface_points(local.scan, mount->second, params.surface, attitude);
    const auto& unconfirmed = local.unconfirmed_beams;
    std::erase_if(points, [&](const SurfacePoint& point) {
      return point.p.norm() > params.range_max_m ||
             std::binary_search(unconfirmed.begin(), unconfirmed.end(), point.beam);
    });
    for (SurfacePoint& point : points) point.z_m += local.z_m;
    surfels.insert(points, local.T_local_body, 0.0);
    const auto last = last_view.find(local.channel);
    if (last != last_view.end() && !new_view(local.T_local_body, last->second, params)) continue;
    last_view[local.channel] = local.T_local_body;
    walls.views.push_back(
        {FreeSpace(local.scan, mount->second, attitude, local.z_m), local.T_local_body});
  }
  const double wall_variance = params.wall_sd_m * params.wall_sd_m;
  walls.length_m = params.spacing_m * static_cast<double>(surfels.surfels().size());
  walls.points.reserve(surfels.surfels().size());
  for (const Surfel& surfel : surfels.surfels()) {
    walls.points.push_back(to_point(surfel, wall_variance));
  }
  return walls;
}

namespace {

/// A view of the free space, prepared for points in the reference frame.
struct PlacedView {
  const FreeSpace* free_space;
  Eigen::Matrix2d R_laser_reference;
  Eigen::Vector2d p_laser_reference;

  explicit PlacedView(const LocalWalls::View& view) : free_space(&view.free_space) {
    const Pose2 T = view.free_space.body_in_laser() * view.T_local_body.inverse();
    R_laser_reference = Eigen::Rotation2Dd(T.theta).toRotationMatrix();
    p_laser_reference = T.translation();
  }

  [[nodiscard]] bool observed_free(const Eigen::Vector2d& p, double z_m, double margin) const {
    return free_space->inside(R_laser_reference * p + p_laser_reference, z_m, margin);
  }
};

double distance_from(const Surfel& wall, const Eigen::Vector2d& p) {
  return wall.has_normal() ? std::abs(wall.normal.dot(p - wall.p)) : (p - wall.p).norm();
}

/// Log-likelihood ratio of a distance from the wall: maps that coincide against chance.
double log_ratio(double distance, const WallAgreementParams& params) {
  const double u = distance / params.wall_sd_m;
  const double on_wall = std::exp(-0.5 * u * u) * 2.0 * params.wall_distance_max_m /
                         (params.wall_sd_m * std::sqrt(2.0 * std::numbers::pi));
  return std::log((1.0 - params.stray_share) * on_wall + params.stray_share);
}

}  // namespace

GroundOffset ground_offset(const std::vector<TraversedPoint>& path, const Pose2& T_reference_path,
                           const std::vector<TraversedPoint>& path_reference) {
  struct Pair {
    double distance_m;
    double offset_m;
    double reference_forward_m;
    double path_forward_m;
  };
  std::vector<Pair> pairs;
  GroundOffset result;
  for (const auto& [p, p_forward_m] : path) {
    const Eigen::Vector2d there = T_reference_path * Eigen::Vector2d(p.head<2>());
    Pair nearest{kSameGroundM, 0.0, 0.0, 0.0};
    for (const auto& [q, q_forward_m] : path_reference) {
      const double distance_m = (q.head<2>() - there).norm();
      if (distance_m < nearest.distance_m) {
        nearest = {distance_m, q.z() - p.z(), q_forward_m, p_forward_m};
      }
    }
    if (nearest.distance_m < kSameGroundM) pairs.push_back(nearest);
    result.distance_m = std::min(result.distance_m, nearest.distance_m);
  }
  std::erase_if(pairs,
                [&](const Pair& pair) { return pair.distance_m > result.distance_m + kAsNearM; });
  if (pairs.empty()) return result;
  const auto middle = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
  std::nth_element(pairs.begin(), middle, pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.offset_m < b.offset_m; });
  result.offset_m = middle->offset_m;
  result.reference_forward_m = middle->reference_forward_m;
  result.path_forward_m = middle->path_forward_m;
  return result;
}

WallAgreement agreement(const std::vector<SurfacePoint>& points, const Pose2& T_reference_points,
                        const SurfelMap& reference, const std::vector<LocalWalls::View>& views,
                        const WallAgreementParams& params, double z_reference_points_m) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_reference_points.theta).toRotationMatrix();
  const std::vector<PlacedView> placed(views.begin(), views.end());
  const double log_near =
      std::log((1.0 - params.contradiction) / (1.0 - params.contradiction_by_chance));
  const double log_contradiction = std::log(params.contradiction / params.contradiction_by_chance);
  WallAgreement result;
  result.points = static_cast<int>(points.size());
  for (const SurfacePoint& point : points) {
    const Eigen::Vector2d p = R * point.p + T_reference_points.translation();
    const Surfel* wall = reference.nearest(p, R * point.normal, params.wall_distance_max_m).surfel;
    if (wall != nullptr) {
      ++result.near;
      result.log_likelihood += log_near + log_ratio(distance_from(*wall, p), params);
    } else if (std::any_of(placed.begin(), placed.end(), [&](const PlacedView& view) {
                 return view.observed_free(p, z_reference_points_m + point.z_m, params.margin_m);
               })) {
      ++result.contradicting;
      result.log_likelihood += log_contradiction;
    }
  }
  return result;
}

std::vector<double> distances_before_walls(const std::vector<SurfacePoint>& points,
                                           const Pose2& T_reference_points,
                                           const SurfelMap& reference, double distance_max_m) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_reference_points.theta).toRotationMatrix();
  std::vector<double> distances;
  for (const SurfacePoint& point : points) {
    const Eigen::Vector2d p = R * point.p + T_reference_points.translation();
    const Surfel* wall = reference.nearest(p, R * point.normal, distance_max_m).surfel;
    if (wall == nullptr || !wall->has_normal()) continue;
    distances.push_back(wall->normal.dot(p - wall->p));
  }
  return distances;
}

}  // namespace adit
