// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning_node.hpp"

#include <stdexcept>

#include <malloc.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

constexpr std::size_t kTileQueueSize = 200;  // several maps

/// Returns freed memory to the system: a search allocates several times what remains after it, and
/// the C library would keep the maximum.
void release_memory() { malloc_trim(0); }

}  // namespace

PlanningNode::PlanningNode(Bus& bus, const Params& params) : bus_(bus), planning_(params) {
  subscribe<terrain_t>(bus, channels::kTerrain, Delivery::queued(kTileQueueSize),
                       [this](const TerrainFragment& tile) {
                         auto terrain = assembler_.add(tile);
                         if (!terrain) return;
                         terrain_ = std::move(terrain);
                         try_plan();
                       });
  subscribe<pose_t>(bus, channels::kPose, Delivery::latest(), [this](const StampedPose& pose) {
    T_odom_body_ = pose.T_odom_body;
    clearance_.add_pose(pose.T_odom_body);
    try_plan();
  });
  subscribe<map_correction_t>(bus, channels::kMapCorrection, Delivery::latest(),
                              [this](const MapCorrection& correction) {
                                clearance_.set_correction(correction.T_map_odom);
                              });
  subscribe<plan_goal_t>(bus, channels::kGoal, Delivery::latest(), [this](const PlanGoal& goal) {
    goal_ = goal;
    try_plan();
  });
}

void PlanningNode::try_plan() {
  if (!goal_ || !T_odom_body_) return;
  if (goal_->kind == PlanGoal::Kind::kRetrace) {
    publish(bus_, channels::kPath, to_message(retraced()));
  } else if (terrain_) {
    PlannedPath path = plan();
    // The part of a rejoin along the traversed path is not over a scan.
    if (goal_->kind == PlanGoal::Kind::kRejoin) {
      clearance_.apply(path);
    } else {
      clearance_.add_path(path);
    }
    publish(bus_, channels::kPath, to_message(path));
    release_memory();
  } else {
    return;
  }
  goal_.reset();
}

/// Along the traversed path, with the clearance that a scan showed outbound.
PlannedPath PlanningNode::retraced() const {
  PlannedPath path = planning_.retraced(*goal_, *T_odom_body_);
  clearance_.apply(path);
  return path;
}

/// Every goal gets an answer, even if the terrain cannot be planned on.
PlannedPath PlanningNode::plan() {
  try {
    failure_.clear();
    return planning_.plan(*terrain_, *goal_, *T_odom_body_);
  } catch (const std::invalid_argument& failure) {
    failure_ = failure.what();
    return {terrain_->utime, goal_->id, PlanOutcome::kSearchLimit, failure_, {}, 0.0, {}};
  }
}

Health PlanningNode::health() const {
  using Level = Health::Level;
  if (!failure_.empty()) return {Level::kDegraded, failure_};
  if (goal_ && !terrain_) return {Level::kDegraded, "goal pending: no terrain received yet"};
  if (goal_) return {Level::kDegraded, "goal pending: no pose received yet"};
  return {};
}

}  // namespace adit
