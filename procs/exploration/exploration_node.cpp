// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_node.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/navigation.hpp"
#include "common/pose_graph/map_correction.hpp"

namespace adit {
namespace {

constexpr std::size_t kFragmentsWaiting = 500;  // several local maps, or a large graph
constexpr std::size_t kTerrainsWaiting = 10;
constexpr std::int64_t kPeriodUs = 1'000'000;
constexpr double kMovedM = 0.05;
constexpr double kPathAheadM = 36.0;  // more than the mission drives on known ground at a time
constexpr double kPathSpacingM = 0.3;
constexpr double kJumpM = 8.0;  // between two poses: a new odom frame, not a motion

std::string evidence_of(const PlannedPath& path) {
  const std::string text = fmt::format("the planner found no path ({})", path.id);
  return path.reason.empty() ? text : fmt::format("{}: {}", text, path.reason);
}

}  // namespace

ExplorationNode::ExplorationNode(Bus& bus, const Params& params)
    : bus_(bus), params_(params), exploration_(params) {
  if (!params.journal.empty()) {
    const StoredExploration& stored = journal_.emplace(params.journal).restored();
    exploration_.restore(stored.exploration);
    exploration_.restore(stored.grounds);
    map_utime_ = stored.map_utime;
    request_ = stored.request;
    distance_at_request_m_ = stored.distance_at_request_m;
    distance_travelled_m_ = stored.distance_travelled_m;
  }
  subscribe<local_map_t>(bus, channels::kLocalMap, Delivery::queued(kFragmentsWaiting),
                         [this](const LocalMapFragment& fragment) {
                           if (const auto map = local_maps_.add(fragment)) on_local_map(*map);
                         });
  subscribe<pose_graph_t>(bus, channels::kPoseGraph, Delivery::queued(kFragmentsWaiting),
                          [this](const PoseGraphFragment& fragment) {
                            if (const auto graph = graphs_.add(fragment)) on_graph(*graph);
                          });
  subscribe<terrain_t>(bus, channels::kTerrain, Delivery::queued(TerrainFragment::kFragmentsMax),
                       [this](const TerrainFragment& fragment) {
                         if (auto terrain = terrain_.add(fragment)) on_terrain(std::move(*terrain));
                       });
  subscribe<map_correction_t>(
      bus, channels::kMapCorrection, Delivery::latest(),
      [this](const MapCorrection& correction) { on_correction(correction); });
  subscribe<pose_t>(bus, channels::kPose, Delivery::latest(),
                    [this](const StampedPose& pose) { on_pose(pose); });
  subscribe<planned_path_t>(bus, channels::kPath, Delivery::queued(10),
                            [this](const PlannedPath& path) { on_path(path); });
  subscribe<explore_request_t>(bus, channels::kExploreRequest, Delivery::queued(10),
                               [this](const ExploreRequest& request) { on_request(request); });
  bus.create_timer(kPeriodUs, [this](std::int64_t utime) { on_tick(utime); });
}

void ExplorationNode::on_tick(std::int64_t utime) {
  if (map_requester_.is_due(utime, !has_map_ || !correction_ || local_maps_missing() > 0)) {
    publish(bus_, channels::kMapRequest, to_message(MapRequest{utime, "exploration"}));
    map_requester_.received(utime);
  }
  if (distance_travelled_m_ - distance_at_publish_m_ > kMovedM) publish_decision();
}

void ExplorationNode::on_local_map(const LocalMap& map) {
  map_requester_.received(bus_.now_utime());
  const auto received = local_maps_received_.find(map.id);
  if (received != local_maps_received_.end() && received->second == map.end_utime) return;
  if (map.id == 0) reset_if_other_map(map);
  // An empty one takes the place of a lost one.
  if (!map.scans.empty() && !exploration_.add(map)) ++local_maps_rejected_;
  local_maps_received_[map.id] = map.end_utime;
  if (!has_map_) apply_graph();
}

/// State that belongs to another map is discarded.
void ExplorationNode::reset_if_other_map(const LocalMap& first) {
  if (map_utime_ != 0 && map_utime_ != first.utime) {
    exploration_.restore(ExplorationMemory{});
    exploration_.restore(std::vector<ScannedGround>{});
    unstored_.clear();
  }
  map_utime_ = first.utime;
}

void ExplorationNode::on_graph(const MapGraph& graph) {
  graph_ = graph;
  apply_graph();
}

std::size_t ExplorationNode::local_maps_missing() const {
  const int n = graph_ ? static_cast<int>(graph_->poses.size()) : 0;
  const auto there =
      std::distance(local_maps_received_.begin(), local_maps_received_.lower_bound(n));
  return static_cast<std::size_t>(n - static_cast<int>(there));
}

/// Waits for the first complete map: with local maps missing, frontiers would seem explored that
/// are not.
void ExplorationNode::apply_graph() {
  if (!graph_ || (!has_map_ && local_maps_missing() > 0)) return;
  if (!exploration_.update(*graph_)) return;
  has_map_ = true;
  place_terrains();
  publish_decision();
}

void ExplorationNode::on_terrain(TerrainMap terrain) {
  unplaced_.push_back(std::move(terrain));
  if (unplaced_.size() > kTerrainsWaiting) unplaced_.pop_front();
  place_terrains();
}

/// Places 3D scans in map, once it is known where odom lies in it.
void ExplorationNode::place_terrains() {
  if (!has_map_ || !correction_ || unplaced_.empty()) return;
  for (const TerrainMap& terrain : unplaced_) {
    const auto* const added =
        exploration_.add(terrain, correction_->T_map_odom * terrain.T_odom_level, z_map_body_m());
    if (added != nullptr && journal_) unstored_.push_back(*added);
  }
  unplaced_.clear();
  publish_decision();
}

void ExplorationNode::on_correction(const MapCorrection& correction) {
  const bool is_first = !correction_;
  correction_ = correction;
  place_terrains();
  if (is_first) publish_decision();
}

/// A jump begins a new odom frame, for which the correction is not valid.
void ExplorationNode::on_pose(const StampedPose& pose) {
  if (pose_) {
    const double step_m = between(pose_->T_odom_body, pose.T_odom_body).translation().norm();
    if (step_m < kJumpM) distance_travelled_m_ += step_m;
    if (step_m >= kJumpM) {
      correction_.reset();
      unplaced_.clear();
    }
  }
  pose_ = pose;
}

/// A rejected plan makes its frontier doubtful. Without requests, repeated failed plans to the same
/// target mark it as blocked.
void ExplorationNode::on_path(const PlannedPath& path) {
  using Kind = ExplorationDecision::Kind;
  const bool has_target = decision_.kind != Kind::kStay && decision_.kind != Kind::kDone;
  const bool rejected = path.outcome == PlanOutcome::kBlocked ||
                        path.outcome == PlanOutcome::kUnknown ||
                        path.outcome == PlanOutcome::kNarrow;
  const bool is_rejection = rejected && path.reached_m < params_.no_path_m;
  if (has_target && is_rejection) exploration_.record_rejection(decision_.frontier);
  if (request_) return;
  if (!has_target || !is_rejection || decision_.frontier != no_path_frontier_) no_paths_ = 0;
  if (!has_target || !is_rejection) return;
  no_path_frontier_ = decision_.frontier;
  if (++no_paths_ < params_.no_path_answers) return;
  no_paths_ = 0;
  exploration_.report_blocked(decision_.frontier, {path.utime, path.reached_m, evidence_of(path)});
  publish_decision();
}

/// A request is repeated until it is answered, and each repetition is answered again; its verdict
/// counts once.
void ExplorationNode::on_request(const ExploreRequest& request) {
  const bool has_map = has_map_ && correction_;
  const bool had_map = map_utime_ != 0;
  if (!pose_ || (!has_map && (had_map || request.blocked))) return;
  const bool is_repeat = request_ && request_->id == request.id;
  if (request.blocked && !is_repeat) report_blocked(*request.blocked);
  request_ = request;
  distance_at_request_m_ = distance_travelled_m_;
  has_map ? publish_decision() : publish_report();
}

/// The verdict refers to the route from where the last decision was made.
void ExplorationNode::report_blocked(const BlockedVerdict& verdict) {
  if (!decided_) decide();
  exploration_.report_blocked(
      verdict.frontier, {verdict.utime, verdict.reached_m, verdict.evidence, verdict.unconfirmed});
}

double ExplorationNode::remaining_m() const {
  const double budget_m = request_ ? request_->remaining_m : params_.budget_m;
  return std::max(0.0, budget_m - (distance_travelled_m_ - distance_at_request_m_));
}

/// The robot stands still from a 3D scan to its terrain map, so that both have this height.
std::optional<double> ExplorationNode::z_map_body_m() const {
  if (!correction_ || !pose_) return std::nullopt;
  return correction_->z_map_odom_m + pose_->z_m;
}

void ExplorationNode::decide() {
  const Pose2 T_map_body = correction_->T_map_odom * pose_->T_odom_body;
  decision_ = exploration_.decide({pose_->utime, T_map_body, remaining_m(),
                                   position_sd_m(*correction_).value_or(0.0),
                                   request_ && request_->returning_home, z_map_body_m()});
  decided_ = true;
}

void ExplorationNode::publish_decision() {
  if (!has_map_ || !correction_ || !pose_) return;
  decide();
  distance_at_publish_m_ = distance_travelled_m_;
  store();
  publish_report();
}

/// Stores before publishing, so that no published decision is lost. What could not be stored is
/// stored with a later decision.
void ExplorationNode::store() {
  if (!journal_) return;
  journal_failure_.clear();
  try {
    while (!unstored_.empty()) {
      journal_->append(map_utime_, unstored_.front());
      unstored_.pop_front();
    }
    journal_->store({map_utime_,
                     exploration_.memory(),
                     {},
                     request_,
                     distance_at_request_m_,
                     distance_travelled_m_});
  } catch (const std::exception& failure) {
    journal_failure_ = failure.what();
  }
}

/// Without a correction there is no map yet, and odom serves as map.
void ExplorationNode::publish_report() {
  ExplorationReport report = exploration_.report();
  report.request = request_ ? request_->id : 0;
  if (has_map_ && correction_) {
    const Pose2 T_odom_map = correction_->T_map_odom.inverse();
    report.T_odom_goal = T_odom_map * report.decision.T_map_goal;
    for (const Eigen::Vector2d& p_map : exploration_.path_ahead(kPathAheadM, kPathSpacingM)) {
      report.route_odom.emplace_back(T_odom_map * p_map);
    }
  } else {
    report.utime = pose_->utime;
    report.decision.reason = "there is no map yet";
    report.decision.T_map_goal = report.T_odom_goal = pose_->T_odom_body;
    report.budget.remaining_m = remaining_m();
  }
  publish(bus_, channels::kExploration, to_message(report));
}

Health ExplorationNode::health() const {
  using Level = Health::Level;
  if (local_maps_rejected_ > 0) {
    return {Level::kDegraded, fmt::format("{} local maps are malformed", local_maps_rejected_)};
  }
  const std::string not_stored = storage_failure(journal_, journal_failure_);
  if (!not_stored.empty()) return {Level::kFault, not_stored};
  if (const std::size_t missing = local_maps_missing(); missing > 0) {
    return {Level::kDegraded, fmt::format("{} local maps are missing", missing)};
  }
  if (distance_at_publish_m_ >= 0.0 && decision_.kind == ExplorationDecision::Kind::kStay) {
    return {Level::kDegraded, decision_.reason};
  }
  if (journal_ && !journal_->damage().empty()) return {Level::kDegraded, journal_->damage()};
  return {};
}

}  // namespace adit
