// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/blockages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "common/types/planned_path.hpp"
#include "tools/report/page/seen_ground.hpp"

namespace adit {
namespace {

constexpr double kOnePlaceM = 5.0;
constexpr double kNearM = 1.0;

/// Reasons of which one observation decides, the first before the others: walls and rubble are
/// beside every path and are named by many plans, water lies across it.
constexpr std::array kDeciding{BlockingCell::Reason::kWater, BlockingCell::Reason::kDrop,
                               BlockingCell::Reason::kRoof,  BlockingCell::Reason::kSlope,
                               BlockingCell::Reason::kBelly, BlockingCell::Reason::kStep};

std::string cause_of(const Frontier& frontier) {
  switch (frontier.state) {
    case FrontierState::kTooNarrow:
      return "a passage that is too narrow";
    case FrontierState::kUnobservable:
      return "ground without laser returns (water or open air)";
    case FrontierState::kUnconfirmed:
      return "no path was found";
    default:
      break;
  }
  for (const BlockingCell::Reason reason : kDeciding) {
    if (frontier.evidence.find(description_of(reason)) != std::string::npos)
      return description_of(reason);
  }
  return "a blocked path";
}

bool ends_exploration(FrontierState state) {
  return state == FrontierState::kBlocked || state == FrontierState::kTooNarrow ||
         state == FrontierState::kUnobservable || state == FrontierState::kUnconfirmed;
}

/// The pose of a path that is nearest to a place.
struct Nearest {
  std::size_t pose = 0;
  double distance_m = std::numeric_limits<double>::infinity();
};

Nearest nearest_pose(const Trajectory& path, const Eigen::Vector2d& p_map) {
  Nearest nearest;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double distance_m = (path[i].pose.translation() - p_map).norm();
    if (distance_m < nearest.distance_m) nearest = {i, distance_m};
  }
  return nearest;
}

/// Distance travelled until the robot first was near a place of its path.
double distance_until_near_m(const Trajectory& path, const Eigen::Vector2d& p_map) {
  const auto near = std::find_if(path.begin(), path.end(), [&](const TimedPose& pose) {
    return (pose.pose.translation() - p_map).norm() < kNearM;
  });
  return distance_travelled_m(Trajectory(path.begin(), near), kTravelStepM);
}

}  // namespace

std::vector<Blockage> blockages(const std::vector<Frontier>& frontiers, const Trajectory& path,
                                const OccupancyGrid* grid) {
  std::vector<Blockage> found;
  std::vector<Eigen::Vector2d> places;  // the nearest pose of each
  if (path.empty()) return found;
  std::optional<SeenGround> seen;
  if (grid != nullptr) seen.emplace(*grid, path);
  for (const Frontier& frontier : frontiers) {
    if (!ends_exploration(frontier.state)) continue;
    const Nearest nearest = nearest_pose(path, frontier.p_map);
    const Eigen::Vector2d p_map = path[nearest.pose].pose.translation();
    const auto same = std::find_if(places.begin(), places.end(), [&](const Eigen::Vector2d& place) {
      return (place - p_map).norm() < kOnePlaceM;
    });
    const auto i = static_cast<std::size_t>(same - places.begin());
    if (same == places.end()) {
      places.push_back(p_map);
      found.emplace_back();
      found.back().at_m = distance_until_near_m(path, p_map);
      if (seen) found.back().seen_beyond_m = seen->beyond_m(p_map);
    }
    Blockage& blockage = found[i];
    const bool proven = is_closed(frontier.state);
    if (blockage.cause.empty() || (proven && !blockage.is_proven)) {
      blockage.cause = cause_of(frontier);
    }
    blockage.is_proven = blockage.is_proven || proven;
    blockage.seen_beyond_m = std::max(blockage.seen_beyond_m, nearest.distance_m);
    blockage.frontier_m += frontier.width_m;
    blockage.frontiers.push_back(frontier.id);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Blockage& a, const Blockage& b) { return a.at_m < b.at_m; });
  return found;
}

}  // namespace adit
