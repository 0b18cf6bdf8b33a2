// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/change_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include "tools/survey/points/point_index.hpp"

namespace adit {
namespace {

constexpr double kSteepCos = 0.7071;  // 45 degrees

/// Sums up the points of a region. Their errors are alike (the pose of a scan), so those of
/// volumes add up.
ChangeRegion region_of(std::vector<std::size_t> cores,
                       const std::vector<SurfaceDistance>& distances) {
  ChangeRegion region;
  std::array<double, 3> by_kind{};
  for (const std::size_t core : cores) {
    const SurfaceDistance& at = distances[core];
    region.p += at.area_m2 * at.p;
    region.area_m2 += at.area_m2;
    region.volume_m3 += at.area_m2 * at.distance_m;
    region.volume_sd_m3 += at.area_m2 * at.sd_m;
    if (std::abs(at.distance_m) > std::abs(region.most_m)) region.most_m = at.distance_m;
    by_kind[static_cast<std::size_t>(kind_of(at.n))] += at.area_m2;
  }
  region.p /= region.area_m2;
  region.mean_m = region.volume_m3 / region.area_m2;
  region.rock_gone = region.volume_m3 < 0.0;
  region.kind = static_cast<SurfaceKind>(std::ranges::max_element(by_kind) - by_kind.begin());
  region.cores = std::move(cores);
  return region;
}

}  // namespace

SurfaceKind kind_of(const Eigen::Vector3d& normal) {
  if (normal.z() > kSteepCos) return SurfaceKind::kFloor;
  return normal.z() < -kSteepCos ? SurfaceKind::kRoof : SurfaceKind::kWall;
}

const char* name_of(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kFloor:
      return "floor";
    case SurfaceKind::kRoof:
      return "roof";
    case SurfaceKind::kWall:
      return "wall";
  }
  return "";
}

const char* ChangeRegion::meaning() const {
  switch (kind) {
    case SurfaceKind::kFloor:
      return rock_gone ? "floor lower: dug, drained or settled"
                       : "floor higher: fallen or deposited";
    case SurfaceKind::kRoof:
      return rock_gone ? "roof higher: fallen from it"
                       : "roof lower: it came down, or something hangs";
    case SurfaceKind::kWall:
      return rock_gone ? "wall farther: spalled or dug"
                       : "wall nearer: it moved in, or something stands";
  }
  return "";
}

std::vector<ChangeRegion> change_regions(const std::vector<SurfaceDistance>& distances,
                                         const ChangeRegionParams& params) {
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  std::vector<bool> open(distances.size(), false);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    open[i] = distances[i].is_significant();
    if (open[i]) cells[voxel_key(distances[i].p, params.reach_m)].push_back(i);
  }
  std::vector<ChangeRegion> regions;
  for (std::size_t seed = 0; seed < distances.size(); ++seed) {
    if (!open[seed]) continue;
    open[seed] = false;
    std::vector<std::size_t> cores{seed};
    for (std::size_t next = 0; next < cores.size(); ++next) {
      const SurfaceDistance& at = distances[cores[next]];
      const Eigen::Vector3i cell = voxel_of(at.p, params.reach_m);
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          for (int z = -1; z <= 1; ++z) {
            const auto found = cells.find(voxel_key(cell + Eigen::Vector3i(x, y, z)));
            if (found == cells.end()) continue;
            for (const std::size_t other : found->second) {
              if (!open[other] || (distances[other].distance_m > 0.0) != (at.distance_m > 0.0) ||
                  (distances[other].p - at.p).norm() > params.reach_m)
                continue;
              open[other] = false;
              cores.push_back(other);
            }
          }
        }
      }
    }
    ChangeRegion region = region_of(std::move(cores), distances);
    const bool clear = std::abs(region.volume_m3) > params.mean_min_sd * region.volume_sd_m3;
    if (clear && region.area_m2 >= params.area_min_m2) regions.push_back(std::move(region));
  }
  std::ranges::stable_sort(regions, std::ranges::greater{},
                           [](const ChangeRegion& region) { return std::abs(region.volume_m3); });
  return regions;
}

}  // namespace adit
