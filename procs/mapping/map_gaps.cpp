// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_gaps.hpp"

#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace adit {
namespace {

constexpr double kUnknownPoseM = 1000.0;
constexpr double kGapM = 1.0;
constexpr double kGapShare = 0.1;
constexpr double kGapRad = 0.2;

Eigen::Matrix3d information_of(double sd_m, double sd_rad) {
  return Eigen::Vector3d(sd_m, sd_m, sd_rad).cwiseInverse().cwiseAbs2().asDiagonal();
}

std::string maps_text(const std::vector<int>& ids) {
  return fmt::format("local map{} {}", ids.size() == 1 ? "" : "s", fmt::join(ids, ", "));
}

}  // namespace

std::string text_of(const MapLosses& losses) {
  std::vector<std::string> parts;
  if (!losses.local_maps.empty()) parts.push_back(maps_text(losses.local_maps) + " lost");
  if (losses.end) parts.emplace_back("the end of the map lost, an unknown number of local maps");
  if (!losses.shortened.empty())
    parts.push_back(maps_text(losses.shortened) + " without some scans");
  if (losses.loop_closures > 0)
    parts.push_back(fmt::format("decisions on loop closures lost: {}", losses.loop_closures));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Eigen::Matrix3d information_across_gap(double unseen_m) {
  return information_of(kGapM + kGapShare * unseen_m, kGapRad);
}

Eigen::Matrix3d information_of_unknown_pose() {
  return information_of(kUnknownPoseM, std::numbers::pi);
}

LocalMap empty_local_map(int id, const LocalMap* before, const LocalMap* next) {
  LocalMap empty;
  empty.id = id;
  empty.information = information_across_gap(0.0);
  if (before != nullptr) {
    empty.session = before->session;
    empty.utime = empty.end_utime = before->end_utime;
    empty.T_odom_local = before->T_odom_local;
    empty.z_odom_m = before->z_odom_m;
    if (!before->scans.empty()) {
      empty.T_previous_local = before->scans.back().T_local_body;
      empty.climb_m = before->scans.back().z_m;
      empty.forward_m = empty.T_previous_local.translation().norm();
      empty.T_odom_local = before->T_odom_local * empty.T_previous_local;
      empty.z_odom_m += empty.climb_m;
    }
  } else if (next != nullptr) {
    empty.utime = empty.end_utime = next->utime;
  }
  return empty;
}

void link_after_gap(LocalMap& map, const LocalMap& empty) {
  map.T_previous_local = {};
  map.climb_m = map.forward_m = 0.0;
  map.information = information_of_unknown_pose();
  if (map.session != empty.session) return;
  map.T_previous_local = between(empty.T_odom_local, map.T_odom_local);
  map.climb_m = map.z_odom_m - empty.z_odom_m;
  map.forward_m = map.T_previous_local.translation().norm();
  map.information = information_across_gap(map.forward_m);
}

}  // namespace adit
