// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/local_walls.hpp"

#include <cmath>

#include "common/registration/surfel_map.hpp"

namespace adit {
namespace {

SurfacePoint to_point(const Surfel& surfel, double wall_variance) {
  SurfacePoint point;
  point.p = surfel.p;
  point.normal = surfel.normal;
  point.normal_variance = surfel.normal_variance;
  point.variance = surfel.variance + wall_variance;
  return point;
}

/// Is this scan's view new enough, against the last one that was kept of its laser?
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
  SurfelMap surfels(thinning);
  std::map<std::string, Pose2> last_view;
  for (const LocalScan& local : map.scans) {
    const auto mount = mounts.find(local.channel);
    if (mount == mounts.end()) continue;
    auto points = surface_points(local.scan, mount->second, params.surface);
    std::erase_if(points, [&](const auto& q) { return q.p.norm() > params.range_max_m; });
    surfels.insert(points, local.T_local_body, 0.0);
    const auto last = last_view.find(local.channel);
    if (last != last_view.end() && !new_view(local.T_local_body, last->second, params)) continue;
    last_view[local.channel] = local.T_local_body;
    walls.views.push_back({FreeSpace(local.scan, mount->second), local.T_local_body});
  }
  const double wall_variance = params.wall_sd_m * params.wall_sd_m;
  walls.length_m = params.spacing_m * static_cast<double>(surfels.surfels().size());
  walls.points.reserve(surfels.surfels().size());
  for (const Surfel& surfel : surfels.surfels()) {
    walls.points.push_back(to_point(surfel, wall_variance));
  }
  return walls;
}

}  // namespace adit
