// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/exploration.hpp"
#include "common/types/local_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/exploration/choice/expected_gain.hpp"
#include "procs/exploration/choice/frontier_choice.hpp"
#include "procs/exploration/choice/patrol.hpp"
#include "procs/exploration/exploration_memory.hpp"
#include "procs/exploration/frontier/frontier_detection.hpp"
#include "procs/exploration/frontier/frontier_register.hpp"
#include "procs/exploration/map/corridor_graph.hpp"
#include "procs/exploration/map/drivable_space.hpp"
#include "procs/exploration/map/known_space.hpp"
#include "procs/exploration/map/shortest_path_tree.hpp"

namespace adit {

struct ExplorationParams {
  Vehicle vehicle;
  Lasers lasers;
  KnownSpaceParams known;
  DrivableParams drivable;
  CorridorGraphParams corridors;
  FrontierRegisterParams frontiers;
  ExpectedGainParams gain;
  FrontierChoiceParams choice;
  std::string mode = "explore";  ///< or "corridor": straight ahead until blocked, then home (paper)
  double step_m = 10.0;          ///< largest path length from the robot to the next goal
  double at_home_m = 0.3;        ///< distance to the start in map that counts as home
  bool exit_behind_start = true;  ///< open air that is observed behind the start is the exit
  /// The robot is put down at the portal, facing in: what lies behind the start is the exit, seen
  /// or not. A robot that is blind behind would drive out before it sees it.
  bool starts_at_portal = false;
  bool patrol = false;  ///< when no frontier is left, patrol instead of returning home

  template <class V>
  void visit(V& v) {
    v.shared(Vehicle::kSection, vehicle);
    v.shared(Lasers::kSection, lasers);
    v("known", known);
    v("drivable", drivable);
    v("corridors", corridors);
    v("frontiers", frontiers);
    v("gain", gain);
    v("choice", choice);
    v("mode", mode, OneOf({"explore", "corridor"}));
    v("step_m", step_m, within(1.0, 100.0));
    v("at_home_m", at_home_m, within(0.1, 10.0));
    v("exit_behind_start", exit_behind_start);
    v("starts_at_portal", starts_at_portal);
    v("patrol", patrol);
  }
};

/// State of the robot for which a decision is made.
struct ExplorationState {
  std::int64_t utime = 0;
  Pose2 T_map_body;
  double remaining_m = 0.0;        ///< path length that battery and time still allow
  double sd_m = 0.0;               ///< standard deviation of the position in map; 0 if unknown
  bool returning_home = false;     ///< the request is for the path home only
  std::optional<double> z_m = {};  ///< height of the body in map; nothing if unknown
};

/// Result of a planner that found no path.
struct BlockedEvidence {
  std::int64_t utime = 0;
  double reached_m = 0.0;    ///< largest progress along the route that was possible
  std::string reason;        ///< one sentence
  bool unconfirmed = false;  ///< the obstacle was not observed, or only once
};

/// Selects the next goal of frontier-based exploration (paper, section 3.3, and what it leaves
/// open). Weighs the expected gain of each frontier of the map against the path to it, under a hard
/// budget that always includes the path home. Levels above each other are explored in layers of
/// their own: inside, positions are in atlas (KnownSpace); all that the class returns is in map.
class Exploration {
 public:
  explicit Exploration(const ExplorationParams& params);

  /// Adds a local map, before the pose graph that contains it. Returns false if it is malformed; it
  /// is then ignored.
  bool add(const LocalMap& map);

  /// Adds what a 3D scan observed, at a pose and a height in map, where that is known. Returns what
  /// was added, to be stored; null if there is no local map with a pose yet.
  const ScannedGround* add(const TerrainMap& terrain, const Pose2& T_map_level,
                           std::optional<double> z_m = {});

  /// Sets the poses of all local maps. Returns false if a pose is not finite; the graph is then
  /// ignored.
  bool update(const MapGraph& graph);

  /// Decides on the next goal, and stores its target. Deterministic: the same map, state and
  /// previous target give the same decision.
  const ExplorationDecision& decide(const ExplorationState& state);

  /// Reports that the planner found no path from where the last decision was made to the frontier.
  /// The frontier is not selected again, nor are frontiers behind the place where the path ended,
  /// unless another path to them is found. On the route home `frontier` is
  /// ExplorationDecision::kNoFrontier, and another route is searched. Returns false if there is no
  /// such frontier or if it is explored. An unconfirmed obstacle is retried once when no other
  /// frontier is left, as is a frontier behind which nothing was observed; neither counts as
  /// complete.
  bool report_blocked(int frontier, const BlockedEvidence& evidence);
  /// The planner found no path to a frontier: it is not explored until the robot has passed it.
  void record_rejection(int frontier) { register_.record_rejection(frontier); }
  /// Reopens a frontier that the operator declares passable.
  bool reopen(int frontier, std::int64_t utime);

  /// State to store beside the map. An Exploration that restores it, and then receives the map,
  /// makes the same decisions as this one.
  [[nodiscard]] ExplorationMemory memory() const;
  void restore(const ExplorationMemory& memory);
  void restore(std::vector<ScannedGround> grounds);

  [[nodiscard]] ExplorationReport report() const;
  [[nodiscard]] std::vector<Frontier> frontiers() const;
  /// Cut where layers meet (separate_layers).
  [[nodiscard]] const CorridorGraph& corridors() const { return corridors_; }
  /// In atlas.
  [[nodiscard]] const DrivableSpace& space() const { return space_; }
  /// Route from where the last decision was made to its target, in map; empty if there is none.
  [[nodiscard]] std::vector<Eigen::Vector2d> route() const { return in_map(route_); }
  /// The next `length_m` of the path in map, as points `spacing_m` apart: along the route, and from
  /// a frontier at its end straight ahead through unseen and drivable space, unless that leads
  /// back. Empty if there is no target.
  [[nodiscard]] std::vector<Eigen::Vector2d> path_ahead(double length_m, double spacing_m) const;
  /// Frontiers that are not closed, with the reason, one sentence each. Empty if the mine is
  /// explored.
  [[nodiscard]] std::vector<std::string> incomplete_reasons() const;

 private:
  void refresh();
  void refresh_space();
  [[nodiscard]] Walls walls() const;
  bool retry_abandoned(std::int64_t utime);
  bool verify_walls();
  [[nodiscard]] std::optional<double> path_length_home_m(const ExplorationState& state) const;
  void set_outside(bool is_outside);
  void drop_passed_barriers(const ExplorationState& state);
  [[nodiscard]] std::vector<BarrierLine> barrier_lines() const;
  [[nodiscard]] std::vector<FrontierRegister::BarrierEvidence> barrier_evidence() const;
  void add_exit_barrier();
  void update_pursuit(const ExplorationState& state, const ShortestPathTree& here);
  [[nodiscard]] bool leads_out(const DetectedFrontier& detected) const;
  [[nodiscard]] std::vector<FrontierCandidate> candidates(const ExplorationState& state,
                                                          const ShortestPathTree& here);
  [[nodiscard]] std::optional<FrontierCandidate> choose(
      const ExplorationState& state, const std::vector<FrontierCandidate>& candidates) const;
  [[nodiscard]] std::optional<int> choose_id(
      const ExplorationState& state, const std::vector<FrontierCandidate>& candidates) const;
  [[nodiscard]] Eigen::MatrixXd path_lengths_between(
      const std::vector<FrontierCandidate>& candidates) const;
  [[nodiscard]] std::optional<int> straight_ahead(
      const ExplorationState& state, const std::vector<FrontierCandidate>& candidates) const;
  [[nodiscard]] ExplorationDecision to_frontier(const FrontierCandidate& candidate,
                                                const ExplorationState& state,
                                                const ShortestPathTree& here);
  [[nodiscard]] ExplorationDecision to_home(const ExplorationState& state, double path_length_m,
                                            std::string reason);
  [[nodiscard]] std::vector<PatrolPlace> patrol_places() const;
  [[nodiscard]] std::optional<ExplorationDecision> to_next_patrol_place(
      const ExplorationState& state, const ShortestPathTree& here);
  [[nodiscard]] ExplorationDecision make_decision(const ExplorationState& state);
  [[nodiscard]] bool fits_as_far_as_known(const Eigen::Vector2d& p_atlas) const;
  [[nodiscard]] double straight_on_m(const Frontier& frontier, double length_m) const;
  [[nodiscard]] double climb_m(const std::vector<Eigen::Vector2d>& path) const;
  [[nodiscard]] FrontierCandidate with_climb(FrontierCandidate candidate,
                                             const Eigen::Vector2d& p_atlas,
                                             const ShortestPathTree& here) const;
  [[nodiscard]] bool leads_away(const Frontier& frontier) const;
  [[nodiscard]] Eigen::Vector2d p_atlas_body(const ExplorationState& state) const;
  [[nodiscard]] Frontier in_map(Frontier frontier) const;
  [[nodiscard]] std::vector<Eigen::Vector2d> in_map(std::vector<Eigen::Vector2d> points) const;
  [[nodiscard]] Pose2 T_map_home() const;

  ExplorationParams params_;
  KnownSpace known_;
  FrontierRegister register_;
  std::vector<Barrier> barriers_;
  DrivableSpace space_;
  std::vector<DetectedFrontier> detected_frontiers_;
  CorridorGraph corridors_;
  std::optional<ShortestPathTree> from_home_;
  std::int64_t utime_ = 0;
  std::int64_t revision_ = 0;
  int pursuit_local_map_ = -1;  ///< newest local map at the last update of the pursuit
  ExplorationState state_;
  ExplorationDecision decision_;
  std::vector<Eigen::Vector2d> route_;  ///< in atlas
  bool returning_ = false;              ///< permanently; in the mode corridor
  /// Every frontier was closed once: from then on walls that may be ground close none.
  bool verify_walls_ = false;
  bool is_outside_ = false;  ///< the robot has passed the exit: routes lead through it
  Patrol patrol_;
  std::optional<PatrolPlace> patrol_target_;  ///< of the last decision, if that is on patrol
};

}  // namespace adit
