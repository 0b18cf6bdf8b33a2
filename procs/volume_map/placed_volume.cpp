// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/placed_volume.hpp"

#include <cmath>
#include <optional>

namespace adit {
namespace {

constexpr double kSameHeadingRad = 0.5;  // largest difference of the headings of equivalent scans

LevelPose viewpoint_in_map(const PlacedVolume& placed) {
  return placed.T_map_volume * placed.T_volume_viewpoint;
}

}  // namespace

StoredVolume stored(const PlacedVolume& placed) {
  const SubVolume& volume = placed.volume;
  return {{volume.cell_m(), volume.utime(), volume.scans(), volume.octree(), volume.points(),
           volume.rejected_points()},
          placed.T_odom_volume,
          placed.anchor,
          placed.T_volume_viewpoint};
}

LevelPose viewpoint_of(const Cloud& cloud) {
  Eigen::Vector2f ahead(0.0F, 0.0F);
  for (const CloudLine& line : cloud.lines) {
    if (is_at_place(cloud, line)) ahead += line.origin.head<2>();
  }
  return {{0.0, 0.0, std::atan2(double{ahead.y()}, double{ahead.x()})}, 0.0};
}

bool is_same_viewpoint(const LevelPose& T_a, const LevelPose& T_b, double replace_radius_m) {
  const LevelPose apart = between(T_a, T_b);
  return std::abs(apart.plan.theta) <= kSameHeadingRad &&
         apart.translation().norm() <= replace_radius_m;
}

void mark_departed(std::vector<PlacedVolume>& volumes, const LevelPose& T_map_viewpoint,
                   double replace_radius_m) {
  for (PlacedVolume& placed : volumes) {
    const double apart_m =
        (viewpoint_in_map(placed).translation() - T_map_viewpoint.translation()).norm();
    placed.departed = placed.departed || apart_m > replace_radius_m;
  }
}

std::vector<std::size_t> volumes_to_replace(const std::vector<PlacedVolume>& volumes,
                                            const LevelPose& T_map_viewpoint,
                                            double replace_radius_m) {
  std::vector<std::size_t> older;
  const auto apart_m = [&](std::size_t i) {
    return (viewpoint_in_map(volumes[i]).translation() - T_map_viewpoint.translation()).norm();
  };
  std::optional<std::size_t> same_visit;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const bool placed = volumes[i].anchor && !volumes[i].excluded && !volumes[i].volume.is_empty();
    if (!placed ||
        !is_same_viewpoint(viewpoint_in_map(volumes[i]), T_map_viewpoint, replace_radius_m))
      continue;
    if (volumes[i].departed) {
      older.push_back(i);
    } else if (!same_visit || apart_m(i) < apart_m(*same_visit)) {
      same_visit = i;
    }
  }
  if (same_visit) older.insert(older.begin(), *same_visit);
  return older;
}

}  // namespace adit
