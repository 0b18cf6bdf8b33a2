// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/types/exploration.hpp"
#include "common/types/map_request.hpp"
#include "common/types/planned_path.hpp"
#include "procs/exploration/exploration.hpp"
#include "procs/exploration/exploration_journal.hpp"

namespace adit {

struct ExplorationNodeParams : ExplorationParams {
  std::string journal;       ///< file that stores the state; empty: no journal
  double budget_m = 2000.0;  ///< path length for the mission, until a request sets it
  int no_path_answers = 2;   ///< failed plans in a row, after which a frontier is blocked
  double no_path_m = 2.5;    ///< a plan that reaches less has failed (paper, section 3.3)

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    v("budget_m", budget_m, at_least(0.0));
    v("no_path_answers", no_path_answers, at_least(1));
    v("no_path_m", no_path_m, above(0.0));
    ExplorationParams::visit(v);
  }
};

/// In:  LOCAL_MAP (local_map_t), POSE_GRAPH (pose_graph_t) and TERRAIN (terrain_t), in fragments;
///      MAP_CORRECTION (map_correction_t); POSE (pose_t); PATH (planned_path_t), for plans that
///      fail to reach the target; EXPLORE_REQUEST (explore_request_t), which requests a decision.
///      From the first request on, the budget and blocked frontiers come from requests, and PATH is
///      ignored.
/// Out: EXPLORATION (exploration_t), after each pose graph and each request, and once a second
///      while the robot moves. The decision is not a command: the mission stage makes a goal of it.
///      Before there is a map a request is answered by kStay, and a request with a verdict is not
///      answered. MAP_REQUEST (map_request_t), while local maps of the graph are missing; the first
///      decision waits for all of them.
/// With a journal the stored state is restored, and takes effect as soon as the map is complete.
class ExplorationNode {
 public:
  using Params = ExplorationNodeParams;

  /// Throws std::runtime_error if the journal cannot be used.
  ExplorationNode(Bus& bus, const Params& params);

  /// Fault if the journal cannot be written; degraded if local maps are malformed or missing, or no
  /// decision is possible.
  [[nodiscard]] Health health() const;

 private:
  void on_local_map(const LocalMap& map);
  void on_graph(const MapGraph& graph);
  void on_terrain(TerrainMap terrain);
  void place_terrains();
  void on_correction(const MapCorrection& correction);
  void on_pose(const StampedPose& pose);
  void on_path(const PlannedPath& path);
  void on_request(const ExploreRequest& request);
  void report_blocked(const BlockedVerdict& verdict);
  [[nodiscard]] double remaining_m() const;
  [[nodiscard]] std::size_t local_maps_missing() const;
  void on_tick(std::int64_t utime);
  void reset_if_other_map(const LocalMap& first);
  void apply_graph();
  [[nodiscard]] std::optional<double> z_map_body_m() const;
  void decide();
  void store();
  void publish_decision();
  void publish_report();

  Bus& bus_;
  Params params_;
  Exploration exploration_;
  LocalMapReassembler local_maps_;
  PoseGraphReassembler graphs_;
  TerrainReassembler terrain_;
  std::deque<TerrainMap> unplaced_;  ///< 3D scans before the first map
  std::optional<MapCorrection> correction_;
  std::optional<StampedPose> pose_;
  std::optional<ExploreRequest> request_;  ///< the newest
  double distance_at_request_m_ = 0.0;     ///< distance travelled when it arrived
  double distance_travelled_m_ = 0.0;
  double distance_at_publish_m_ = -1.0;  ///< at the last published decision; -1: none
  int no_paths_ = 0;                     ///< failed plans in a row, to the current target
  int no_path_frontier_ = ExplorationDecision::kNoFrontier;
  MapRequestTimer map_requester_;
  std::map<int, std::int64_t> local_maps_received_;  ///< end times, by id; also of rejected ones
  std::optional<MapGraph> graph_;                    ///< the newest
  bool has_map_ = false;  ///< all local maps of a graph were received once
  bool decided_ = false;
  std::size_t local_maps_rejected_ = 0;
  std::optional<ExplorationJournal> journal_;
  std::string journal_failure_;
  std::deque<ScannedGround> unstored_;  ///< not in the journal yet
  std::int64_t map_utime_ = 0;          ///< of the first scan of the map, as in StoredExploration
  ExplorationDecision decision_;
};

}  // namespace adit
