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
  std::string mode = "explore";   ///< or "corridor": straight on until blocked, then home (paper)
  double step_m = 10.0;           ///< from here to the next goal at most
  double at_home_m = 0.3;         ///< from the start, by the map
  bool exit_behind_start = true;  ///< the mine lies ahead of the start, the way out behind it
  bool patrol = false;  ///< once no stub is left, on to what was seen longest ago, not home at once

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
    v("patrol", patrol);
  }
};

/// The robot as it is when it asks where to go.
struct ExplorationState {
  std::int64_t utime = 0;
  Pose2 T_map_body;
  double remaining_m = 0.0;     ///< way that battery and time still allow
  double sd_m = 0.0;            ///< of the pose in map, where it is known
  bool returning_home = false;  ///< nothing but the way home is asked for
};

/// What a planner says who found no path.
struct BlockedEvidence {
  std::int64_t utime = 0;
  double reached_m = 0.0;    ///< farthest progress that was possible
  std::string reason;        ///< a sentence
  bool unconfirmed = false;  ///< what would be in the way was not seen, or not twice
};

/// Where to go next, so that the mine is explored to the end and the robot comes home: the stubs of
/// the map, their gain against the way there, and a hard budget for the way home (the paper's
/// section 3.3 and what it leaves open).
class Exploration {
 public:
  explicit Exploration(const ExplorationParams& params);

  /// A local map, before the graph that knows it. False where it is malformed, and left out.
  bool add(const LocalMap& map);

  /// Where all local maps are now. A graph with a pose that is not finite is left out: false.
  bool update(const MapGraph& graph);

  /// The same map, state and target give the same answer. `decide` keeps the target.
  const ExplorationDecision& decide(const ExplorationState& state);

  /// The planner found no way to the stub from where the last decision was made. It is not chosen
  /// again, nor is what lies behind the place where the way ended, unless another way is found.
  /// On the way home there is no stub (ExplorationDecision::kNoFrontier), and another way is looked
  /// for. False where there is no such stub or it is explored.
  /// What is doubtful is tried once more when nothing else is left, as is what it saw nothing of,
  /// and is never complete.
  bool report_blocked(int frontier, const BlockedEvidence& evidence);
  /// A person says that it is not blocked.
  bool reopen(int frontier, std::int64_t utime);

  /// What is to be kept beside the map; with it, and then the map, another goes on as this one
  /// would.
  [[nodiscard]] ExplorationMemory memory() const;
  void restore(const ExplorationMemory& memory);

  [[nodiscard]] ExplorationReport report() const;
  [[nodiscard]] const std::vector<Frontier>& frontiers() const { return register_.frontiers(); }
  [[nodiscard]] const CorridorGraph& corridors() const { return corridors_; }
  [[nodiscard]] const DrivableSpace& space() const { return space_; }
  /// From where the last decision was made to its target, in map; empty where there is none.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& route() const { return route_; }
  /// The next `length_m` of the way in map, places `spacing_m` apart: along the route, and where
  /// it ends at a stub, straight on from there unless that would lead back. Empty where there is
  /// nowhere to go.
  [[nodiscard]] std::vector<Eigen::Vector2d> path_ahead(double length_m, double spacing_m) const;
  /// The stubs that are not closed, with why, one sentence each; empty: the mine is explored.
  [[nodiscard]] std::vector<std::string> incomplete_reasons() const;

 private:
  void refresh();
  bool retry_abandoned(std::int64_t utime);
  [[nodiscard]] bool has_no_path_home(const ExplorationState& state) const;
  void drop_passed_barriers(const ExplorationState& state);
  [[nodiscard]] std::vector<BarrierLine> barrier_lines() const;
  [[nodiscard]] std::vector<FrontierRegister::BarrierEvidence> barrier_evidence() const;
  void add_exit_barrier();
  void update_pursuit(const ExplorationState& state, const ShortestPathTree& here);
  [[nodiscard]] bool leads_out(const DetectedFrontier& end) const;
  [[nodiscard]] std::vector<FrontierCandidate> candidates(const ExplorationState& state,
                                                          const ShortestPathTree& here);
  [[nodiscard]] std::optional<int> choose(const ExplorationState& state,
                                          const std::vector<FrontierCandidate>& candidates) const;
  [[nodiscard]] Eigen::MatrixXd path_lengths_between(
      const std::vector<FrontierCandidate>& candidates) const;
  [[nodiscard]] std::optional<int> straight_on(
      const ExplorationState& state, const std::vector<FrontierCandidate>& candidates) const;
  [[nodiscard]] ExplorationDecision to_frontier(int frontier, const ExplorationState& state,
                                                const ShortestPathTree& here);
  [[nodiscard]] ExplorationDecision to_home(const ExplorationState& state, std::string reason);
  [[nodiscard]] std::vector<PatrolPlace> places() const;
  [[nodiscard]] std::optional<ExplorationDecision> to_next_patrol_place(
      const ExplorationState& state, const ShortestPathTree& here);
  [[nodiscard]] ExplorationDecision make_decision(const ExplorationState& state);
  [[nodiscard]] bool leads_on(const Frontier& frontier) const;
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
  int pursuit_local_map_ = -1;  ///< local map, when the pursuit of the target was last looked at
  ExplorationState state_;
  ExplorationDecision decision_;
  std::vector<Eigen::Vector2d> route_;
  bool returning_ = false;  ///< for good: in the mode corridor
  Patrol patrol_;
  std::optional<PatrolPlace>
      patrol_target_;  ///< target of the last decision, where that is no stub
};

}  // namespace adit
