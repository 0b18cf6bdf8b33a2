// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/map_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/eval/world_walls.hpp"

namespace adit {
namespace {

constexpr double kScanSpacingM = 0.5;  // along the path
constexpr int kBeams = 720;            // per scan
constexpr double kPointSpacingM = 0.1;
constexpr double kWallDistanceMaxM = 5.0;

/// Horizontal rays over 360°.
std::vector<Ray> horizontal_rays(const Eigen::Vector3d& from) {
  std::vector<Ray> rays;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kBeams;
    rays.push_back(
        {from.cast<float>(), Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>()});
  }
  return rays;
}

std::vector<Eigen::Vector2d> visible_walls(const Site& site, const WorldWalls& walls,
                                           const Trajectory& truth,
                                           const MapScoreOptions& options) {
  std::vector<Eigen::Vector2d> visible;
  for (const auto& [utime, T_world_body, z_m] : downsampled(truth, kScanSpacingM)) {
    const WorldTruth& world_truth = site.world().truth;
    const int level = world_truth.level_at({T_world_body.x, T_world_body.y, z_m});
    const auto floor_m = world_truth.floor_at(T_world_body.translation(), level);
    if (!floor_m) continue;
    const std::vector<Ray> rays =
        horizontal_rays({T_world_body.x, T_world_body.y, *floor_m + options.laser_height_m});
    std::vector<RayHit> hits(rays.size());
    site.scene().cast(rays, static_cast<float>(options.range_m), hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (std::isinf(hits[i].distance_m) || !walls.is_wall(hits[i].triangle)) continue;
      const Eigen::Vector3f p_world = rays[i].origin + hits[i].distance_m * rays[i].direction;
      visible.emplace_back(p_world.head<2>().cast<double>());
    }
  }
  return downsampled(visible, kPointSpacingM);
}

/// Points on the outlines, kPointSpacingM apart.
std::vector<Eigen::Vector2d> outline_points(const std::vector<PlanRing>& rings) {
  std::vector<Eigen::Vector2d> points;
  for (const PlanRing& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Eigen::Vector2d& a = ring.points[i];
      const Eigen::Vector2d& b = ring.points[(i + 1) % ring.points.size()];
      const int count = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kPointSpacingM)));
      for (int k = 0; k < count; ++k) {
        points.emplace_back(a + (b - a) * (static_cast<double>(k) / count));
      }
    }
  }
  return points;
}

double covered_share(const std::vector<Eigen::Vector2d>& points, const NearestPoints& mapped) {
  const auto near = std::count_if(points.begin(), points.end(), [&](const auto& p) {
    return std::isfinite(mapped.distance_m(p));
  });
  return static_cast<double>(near) / static_cast<double>(points.size());
}

/// Mean and quantiles. Sorts the distances.
WallDistances wall_distances(std::vector<double>& distances) {
  std::sort(distances.begin(), distances.end());
  const auto count = static_cast<double>(distances.size());
  const auto at = [&](double share) {
    return distances[static_cast<std::size_t>(share * (count - 1.0))];
  };
  return {std::accumulate(distances.begin(), distances.end(), 0.0) / count, at(0.5), at(0.95)};
}

}  // namespace

std::vector<Eigen::Vector2d> visible_walls(const Site& site, const Trajectory& truth,
                                           const MapScoreOptions& options) {
  return visible_walls(site, WorldWalls(site.world(), kWallDistanceMaxM), truth, options);
}

MapScore score_map(const std::vector<Eigen::Vector2d>& mapped, const Pose2& T_world_map,
                   const Site& site, const Trajectory& truth, const MapScoreOptions& options) {
  if (mapped.empty()) throw std::runtime_error("the map has no occupied cell");
  std::vector<Eigen::Vector2d> points;  // p_world
  for (const Eigen::Vector2d& p_map : mapped) points.emplace_back(T_world_map * p_map);

  const WorldWalls walls(site.world(), kWallDistanceMaxM);
  const std::vector<Eigen::Vector2d> visible = visible_walls(site, walls, truth, options);
  if (visible.empty()) {
    throw std::runtime_error(fmt::format(
        "no wall of {} is visible from the true path: is it the right world?", site.world().name));
  }
  MapScore score;
  score.mapped_points = points.size();
  score.reference_points = visible.size();
  const NearestPoints nearest(points, options.tolerance_m);
  score.coverage = covered_share(visible, nearest);
  const std::vector<Eigen::Vector2d> outlines = outline_points(site.world().truth.plan);
  if (!outlines.empty()) score.coverage_of_mine = covered_share(outlines, nearest);

  std::vector<double> distances;
  for (const Eigen::Vector2d& p : points) {
    distances.push_back(std::min(kWallDistanceMaxM, walls.distance_m(p)));
  }
  const auto far = std::count_if(distances.begin(), distances.end(),
                                 [&](double distance) { return distance > options.deviation_m; });
  score.deviation = static_cast<double>(far) / static_cast<double>(points.size());
  score.wall_distance = wall_distances(distances);
  return score;
}

namespace {

using Json = nlohmann::ordered_json;

/// Heights are null if the trajectory has none.
Json json_of(const PositionErrors& errors, bool heights) {
  Json json = {{"rmse_m", errors.rmse_m},     {"mean_m", errors.mean_m},
               {"max_m", errors.max_m},       {"rmse_x_m", errors.x.rmse_m},
               {"rmse_y_m", errors.y.rmse_m}, {"rmse_z_m", nullptr},
               {"max_z_m", nullptr}};
  if (!heights) return json;
  json["rmse_z_m"] = errors.z.rmse_m;
  json["max_z_m"] = errors.z.max_m;
  return json;
}

/// Without errors if there are no segments.
Json json_of(const RelativeErrors& errors) {
  Json json = {{"length_m", errors.length_m}, {"segments", errors.segments}};
  if (errors.segments == 0) return json;
  json["translation_m"] = errors.translation_m;
  json["rotation_deg"] = errors.rotation_deg;
  return json;
}

Json json_of(const TrajectoryScore& score) {
  Json relative = Json::array();
  for (const RelativeErrors& errors : score.relative) relative.push_back(json_of(errors));
  return {{"poses", score.poses},
          {"aligned", json_of(score.aligned, score.heights)},
          {"anchored", json_of(score.anchored, score.heights)},
          {"relative", relative},
          {"true_length_m", score.true_length_m},
          {"length_ratio", score.length_ratio}};
}

Json json_of(const MapScore& score) {
  Json json = {{"mapped_points", score.mapped_points},
               {"reference_points", score.reference_points},
               {"coverage", score.coverage},
               {"coverage_of_mine", nullptr},
               {"deviation", score.deviation},
               {"wall_distance",
                {{"mean_m", score.wall_distance.mean_m},
                 {"median_m", score.wall_distance.median_m},
                 {"p95_m", score.wall_distance.p95_m}}}};
  if (score.coverage_of_mine) json["coverage_of_mine"] = *score.coverage_of_mine;
  return json;
}

}  // namespace

std::string to_json(const TrajectoryScore& trajectory, const MapScore& map) {
  return Json{{"trajectory", json_of(trajectory)}, {"map", json_of(map)}}.dump(2);
}

}  // namespace adit
