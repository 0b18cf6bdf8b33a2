// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/types/exploration.hpp"
#include "common/types/map_request.hpp"
#include "common/types/planned_path.hpp"
#include "procs/exploration/exploration.hpp"
#include "procs/exploration/exploration_journal.hpp"

namespace adit {

struct ExplorationNodeParams : ExplorationParams {
  std::string journal;       ///< file that keeps what was learnt; empty: nothing is kept
  double budget_m = 2000.0;  ///< of way, there and back, since the stage began, until it is asked
  int no_path_answers = 2;   ///< of the planner in a row, after which a stub is blocked
  double no_path_m = 2.5;    ///< an answer that reaches less is none (paper, section 3.3)

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    v("budget_m", budget_m, at_least(0.0));
    v("no_path_answers", no_path_answers, at_least(1));
    v("no_path_m", no_path_m, above(0.0));
    ExplorationParams::visit(v);
  }
};

/// In:  LOCAL_MAP (local_map_t) and POSE_GRAPH (pose_graph_t), both in pieces; MAP_CORRECTION
///      (map_correction_t); POSE (pose_t); PATH (planned_path_t), which may find no way to the
///      present target; EXPLORE_REQUEST (explore_request_t), which asks for a decision. From the
///      first on, what is left of the budget and what is blocked is what they say, and PATH says
///      nothing any more.
/// Out: EXPLORATION (exploration_t), whenever the graph came or it was asked, and once a second
///      while the robot moves. It orders nothing: whoever sequences the mission makes a goal of the
///      decision. Before there is a map a request is answered by kStay, and one with a verdict is
///      left unanswered. MAP_REQUEST (map_request_t), while local maps of the graph are missing;
///      before the first decision all of them are waited for.
/// Where a journal is named and there, it goes on from where it was, as soon as the map is there.
class ExplorationNode {
 public:
  using Params = ExplorationNodeParams;

  /// Throws std::runtime_error where the journal cannot be used.
  ExplorationNode(Bus& bus, const Params& params);

  /// Degraded where local maps are malformed or missing, or nothing can be decided.
  [[nodiscard]] Health health() const;

 private:
  void on_local_map(const LocalMap& map);
  void on_graph(const MapGraph& graph);
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
  void decide();
  void store();
  void publish_decision();
  void publish_report();

  Bus& bus_;
  Params params_;
  Exploration exploration_;
  LocalMapReassembler local_maps_;
  PoseGraphReassembler graphs_;
  std::optional<MapCorrection> correction_;
  std::optional<StampedPose> pose_;
  std::optional<ExploreRequest> request_;  ///< the newest
  double distance_at_request_m_ = 0.0;     ///< way when that came
  double distance_travelled_m_ = 0.0;
  double distance_at_publish_m_ = -1.0;  ///< way when the last decision was published
  int no_paths_ = 0;                     ///< answers in a row, to the present target
  int no_path_frontier_ = ExplorationDecision::kNoFrontier;
  MapRequestTimer map_requester_;
  std::map<int, std::int64_t> local_maps_received_;  ///< ends, by id; the refused ones too
  std::optional<MapGraph> graph_;                    ///< the newest
  bool has_map_ = false;                             ///< all of a graph was there once
  bool decided_ = false;
  std::size_t local_maps_rejected_ = 0;
  std::optional<ExplorationJournal> journal_;
  std::string journal_failure_;
  std::int64_t map_utime_ = 0;  ///< of the first scan of the map, as in StoredExploration
  ExplorationDecision decision_;
};

}  // namespace adit
