// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/level_consistency.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "tools/eval/trajectory_score.hpp"

namespace adit {
namespace {

constexpr double kStepM = 0.5;
constexpr double kLevelM = 1.0;     // heights of the ground in one tunnel differ by less
constexpr double kSlopeMax = 0.35;  // of ground that a vehicle drives on
constexpr double kSameM = 1.0;      // places in the map that are the same
constexpr double kElsewhereM = 3.0;

using Path = std::vector<Eigen::Vector3d>;

/// The true positions during each local map.
std::map<int, Path> paths_of(const std::map<int, std::int64_t>& utimes, const Trajectory& truth) {
  std::map<int, Path> paths;
  for (const TimedPose& at : truth) {
    auto last = utimes.end();
    for (auto map = utimes.begin(); map != utimes.end() && map->second <= at.utime; ++map) {
      last = map;
    }
    if (last != utimes.end()) paths[last->first].push_back(at.position());
  }
  return paths;
}

bool on_different_levels(const Path& a, const Path& b) {
  double nearest_m = std::numeric_limits<double>::infinity();
  double rise_m = 0.0;
  for (const Eigen::Vector3d& p : a) {
    for (const Eigen::Vector3d& q : b) {
      const double distance_m = (p - q).head<2>().norm();
      if (distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      rise_m = std::abs(p.z() - q.z());
    }
  }
  return std::isfinite(nearest_m) && rise_m > kLevelM + kSlopeMax * nearest_m;
}

bool are_same(const TimedPose& a, const TimedPose& b) {
  return (a.position() - b.position()).head<2>().norm() < kSameM &&
         std::abs(a.z_m - b.z_m) < kSameM;
}

double merged_m(const Trajectory& mapped, const Trajectory& truth) {
  std::vector<TimedPose> in_map;
  Path in_world;
  for (const TimedPose& at : downsampled(mapped, kStepM)) {
    const auto real = interpolate_in_space(truth, at.utime);
    if (!real) continue;
    in_map.push_back(at);
    in_world.push_back(real->position());
  }
  double merged_m = 0.0;
  for (std::size_t i = 0; i < in_map.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!are_same(in_map[i], in_map[k])) continue;
      if ((in_world[i] - in_world[k]).norm() <= kElsewhereM) continue;
      merged_m += kStepM;
      break;
    }
  }
  return merged_m;
}

}  // namespace

LevelConsistency score_levels(const std::set<std::array<int, 2>>& loop_closures,
                              const std::map<int, std::int64_t>& utimes, const Trajectory& mapped,
                              const Trajectory& truth) {
  LevelConsistency levels;
  levels.loop_closures = loop_closures.size();
  std::map<int, Path> paths = paths_of(utimes, downsampled(truth, kStepM));
  for (const auto& [from, to] : loop_closures) {
    levels.between_levels += on_different_levels(paths[from], paths[to]) ? 1 : 0;
  }
  levels.merged_m = merged_m(mapped, truth);
  return levels;
}

}  // namespace adit
