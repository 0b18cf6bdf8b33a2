// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/driven_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/types/body_outline.hpp"
#include "procs/terrain/memory/height_plane.hpp"
#include "procs/terrain/memory/remembered_map.hpp"

namespace adit {
namespace {

constexpr float kUnknownHeight = std::numeric_limits<float>::quiet_NaN();
constexpr float kNoRoof = std::numeric_limits<float>::infinity();
constexpr double kObservedShare = 0.2;  // share of the cells under the body that must be observed
constexpr float kInterpolationMaxM = 3.0F;  // of path length, between two heights
constexpr float kExtrapolationMaxM = 0.5F;  // of path length, beyond the last height
constexpr float kSinceM =
    0.05F;  // path length since an observation, to be certain that it is older
constexpr double kSpreadM = 0.1;   // regularization of the grade of the ground under the body
constexpr double kAlongM = 2.0;    // reach of the ground before and behind the body, for its grade
constexpr double kContactM = 0.1;  // contact of a wheel, before and behind its axle

/// Visits the cells whose centre lies in a part of the body frame.
template <class Visit>
void visit_cells(const TerrainMap& map, const Pose2& T_level_body, const ConvexPolygon& part,
                 const Visit& visit) {
  const Eigen::Vector2d middle = 0.5 * (part.low() + part.high());
  const double radius_m = 0.5 * (part.high() - part.low()).norm();
  const Eigen::Vector2i at = map.cell_at(T_level_body * middle);
  const int reach = static_cast<int>(std::ceil(radius_m / map.cell_m));
  const Eigen::Vector2i first = (at.array() - reach).max(0);
  const Eigen::Vector2i last = (at.array() + reach).min(map.cells.box().to.array() - 1);
  const Eigen::Isometry2d T_body_level = motion_of(T_level_body.inverse());
  for (int r = first.y(); r <= last.y(); ++r) {
    for (int c = first.x(); c <= last.x(); ++c) {
      if (part.contains(T_body_level * map.centre(c, r))) visit(map.cells.index({c, r}));
    }
  }
}

/// Where the wheels touch the ground.
std::vector<ConvexPolygon> wheel_contacts(const Vehicle& vehicle) {
  const Eigen::Vector2d half(kContactM, vehicle.wheel_width_m / 2.0);
  std::vector<ConvexPolygon> contacts;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector2d wheel(x * vehicle.wheelbase_m, y * vehicle.track_m);
      contacts.push_back(ConvexPolygon::rectangle(wheel, half));
    }
  }
  return contacts;
}

/// The observed ground in a part of the body frame, relative to the origin of the body.
HeightPlaneFit observed_ground(const TerrainMap& map, const Pose2& T_level_body,
                               const ConvexPolygon& part, const Vehicle& vehicle) {
  HeightPlaneFit sums;
  visit_cells(map, T_level_body, part, [&](std::size_t i) {
    const TerrainCell& cell = map.cells[i];
    if (cell.ground != Ground::kObserved || is_obstacle(cell, obstacle_height_m(vehicle))) return;
    const Eigen::Vector2i at = map.cells.cell(i);
    const Eigen::Vector2d from_body = map.centre(at.x(), at.y()) - T_level_body.translation();
    sums.add(from_body.cast<float>(), cell.low_m);
  });
  return sums;
}

}  // namespace

DrivenGround::DrivenGround(const TerrainMap& map, const std::vector<DrivenPath::Place>& places,
                           const Vehicle& vehicle)
    : vehicle_(vehicle), outline_(body_outline(vehicle)), wheels_(wheel_contacts(vehicle)) {
  for (const DrivenPath::Place& place : places) {
    const Pose2 T_level_body = between(map.T_odom_level, place.T_odom_body);
    const bool here = &place == &places.back();
    poses_.push_back({T_level_body, static_cast<float>(place.distance_travelled_m),
                      here ? 0.0F : observed_height_m(map, T_level_body)});
  }
  interpolate();
}

float DrivenGround::observed_height_m(const TerrainMap& map, const Pose2& T_level_body) const {
  const HeightPlaneFit sums = observed_ground(map, T_level_body, outline_, vehicle_);
  const double cells = outline_.area_m2() / (map.cell_m * map.cell_m);
  const auto observed = static_cast<double>(sums.count());
  return observed > 0.0 && observed >= kObservedShare * cells ? sums.plane(kSpreadM).offset_m
                                                              : kUnknownHeight;
}

/// Of the plane through the ground under the middle of the body, in level.
Eigen::Vector2f DrivenGround::grade_around(const TerrainMap& map, const BodyPose& pose) const {
  const auto around = ConvexPolygon::rectangle(Eigen::Vector2d::Zero(),
                                               outline_.high() + Eigen::Vector2d(kAlongM, 0.0));
  const HeightPlaneFit sums = observed_ground(map, pose.T_level_body, around, vehicle_);
  return sums.plane_through(pose.z_m, kSpreadM).grade;
}

void DrivenGround::interpolate() {
  const std::vector<BodyPose> known = [&] {
    std::vector<BodyPose> known_poses;
    for (const BodyPose& pose : poses_) {
      if (!std::isnan(pose.z_m)) known_poses.push_back(pose);
    }
    return known_poses;
  }();
  for (BodyPose& pose : poses_) {
    if (!std::isnan(pose.z_m)) continue;
    // The height of the newest place is known, so that there always is one after.
    const auto after = std::find_if(known.begin(), known.end(), [&](const BodyPose& other) {
      return other.distance_travelled_m >= pose.distance_travelled_m;
    });
    if (after == known.end()) continue;
    const float ahead_m = after->distance_travelled_m - pose.distance_travelled_m;
    if (after == known.begin()) {
      if (ahead_m <= kExtrapolationMaxM) pose.z_m = after->z_m;
      continue;
    }
    const BodyPose& before = *(after - 1);
    const float between_m = after->distance_travelled_m - before.distance_travelled_m;
    if (between_m > 0.0F && between_m <= kInterpolationMaxM) {
      pose.z_m = std::lerp(after->z_m, before.z_m, ahead_m / between_m);
    }
  }
}

void DrivenGround::fill_driven(TerrainMap& map, const std::vector<std::uint8_t>& changed,
                               const std::vector<float>& observed_at_m) const {
  const ConvexPolygon grown = outline_.grown(map.cell_m / 2.0);
  const auto belly_m = static_cast<float>(vehicle_.belly_clearance_m);
  for (const BodyPose& pose : poses_) {
    visit_cells(map, pose.T_level_body, grown, [&](std::size_t i) {
      TerrainCell& cell = map.cells[i];
      if (std::isnan(cell.clearance_m)) cell.clearance_m = kNoRoof;
      // Regions enlarge obstacles, and odom is inaccurate by centimetres.
      const bool was_obstacle =
          is_obstacle(cell, belly_m) && pose.distance_travelled_m > observed_at_m[i] + kSinceM;
      if (was_obstacle) cell.ground = Ground::kNeverObserved;
    });
  }
  for (const BodyPose& pose : poses_) {
    if (std::isnan(pose.z_m)) continue;
    fill_wheels(map, changed, pose);
  }
}

void DrivenGround::fill_wheels(TerrainMap& map, const std::vector<std::uint8_t>& changed,
                               const BodyPose& pose) const {
  std::vector<std::size_t> cells;
  for (const ConvexPolygon& wheel : wheels_) {
    visit_cells(map, pose.T_level_body, wheel, [&](std::size_t i) {
      if (is_unknown(map.cells[i]) && changed[i] == 0) cells.push_back(i);
    });
  }
  if (cells.empty()) return;
  const Eigen::Vector2f grade = grade_around(map, pose);
  for (const std::size_t i : cells) {
    TerrainCell& cell = map.cells[i];
    const Eigen::Vector2i at = map.cells.cell(i);
    const Eigen::Vector2d from_body = map.centre(at.x(), at.y()) - pose.T_level_body.translation();
    cell.ground = Ground::kObserved;
    cell.count = 0;
    cell.low_m = cell.high_m = pose.z_m + grade.dot(from_body.cast<float>());
  }
}

}  // namespace adit
