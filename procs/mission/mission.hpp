// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/exploration.hpp"
#include "common/types/mission.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"
#include "procs/mission/homeward_detour.hpp"
#include "procs/mission/maneuver.hpp"
#include "procs/mission/mission_limits.hpp"
#include "procs/mission/mission_localization.hpp"
#include "procs/mission/phase_clock.hpp"
#include "procs/mission/progress.hpp"
#include "procs/mission/recovery.hpp"
#include "procs/mission/rolled_distance.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {

struct MissionParams {
  Lasers lasers;
  Vehicle vehicle;
  MissionLimitsParams limits;
  std::string start = "immediately";      ///< or "on_order": a person starts the mission
  std::string after_power_loss = "home";  ///< or "resume"
  double back_off_m = 3.0;                ///< to another viewpoint if no path is found
  double relocalization_wait_s = 30.0;    ///< for a map correction after odom was reset
  double exploration_wait_s = 30.0;       ///< for a decision of exploration
  int failed_tries_max = 10;              ///< in a row without a path before it is stranded
  double home_tolerance_m = 0.5;          ///< from the start pose; accepted as home there
  int home_retries = 2;                   ///< after so many tries to get nearer, or to be surer
  double home_uncertainty_max_m = 0.5;    ///< with 95 %; above it the end is not surely home

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
    v("limits", limits);
    v("start", start, OneOf({"immediately", "on_order"}));
    v("after_power_loss", after_power_loss, OneOf({"home", "resume"}));
    v("back_off_m", back_off_m, within(0.5, 10.0));
    v("relocalization_wait_s", relocalization_wait_s, within(0.0, 600.0));
    v("exploration_wait_s", exploration_wait_s, within(0.0, 600.0));
    v("failed_tries_max", failed_tries_max, at_least(1));
    v("home_tolerance_m", home_tolerance_m, within(0.0, 10.0));
    v("home_retries", home_retries, at_least(0));
    v("home_uncertainty_max_m", home_uncertainty_max_m, above(0.0));
  }
};

/// The requests to the stages. Each is repeated until it is answered.
struct MissionRequests {
  std::optional<ExploreRequest> explore;
  std::optional<ScanRequest> scan;
  std::optional<PlanGoal> goal;
};

/// The sequence of a mission (paper, section 3): explore, scan, plan, execute, from the start into
/// the mine and home again. The class has neither map nor terrain: it sends requests to the stages,
/// evaluates their answers and decides when to return home. Every wait has a timeout.
class Mission {
 public:
  explicit Mission(const MissionParams& params)
      : params_(params),
        limits_(params.limits),
        home_arrival_(params.home_tolerance_m, params.home_retries) {}

  /// Continues a mission after a restart of its process. `start_utime`: when the mission began [µs
  /// since the epoch]; `path`: all stored poses, oldest first; `known_map`: see known_map().
  void restore(const MissionPhase& last, std::int64_t start_utime,
               std::vector<StoredPathPose> path = {}, KnownMap known_map = {});

  /// Returns the pose if it must be stored.
  std::optional<StoredPathPose> add_pose(std::int64_t utime, const Pose2& T_odom_body,
                                         double z_odom_m = 0.0);
  void add_match(const ScanMatch& match);
  void add_correction(const MapCorrection& correction);
  void add_vehicle_state(const VehicleState& state);
  void add_exploration(const ExplorationReport& report);
  void add_cloud(std::int32_t id, bool complete);
  void add_terrain(std::int64_t utime, std::int32_t id);
  void add_path(const PlannedPath& path);
  void add_driving(const DrivingState& state);
  void add_order(const MissionOrder& order);
  [[nodiscard]] MissionLimits& limits() { return limits_; }

  /// Advances time and returns the requests to send now. Call it about ten times per second.
  MissionRequests advance(std::int64_t utime);

  [[nodiscard]] const MissionPhase& phase() const { return phase_; }
  /// What to store of the map, to recognise after a restart that it has lost its end.
  [[nodiscard]] const KnownMap& known_map() const { return localization_.known_map(); }
  /// Why the robot does not know where home is; empty if it does.
  [[nodiscard]] const std::optional<std::string>& home_unknown() const {
    return known_map().home_unknown;
  }

 private:
  /// The latest messages that later decisions need.
  struct Inputs {
    std::optional<std::int64_t> terrain_utime;  ///< of the newest terrain
    double terrain_distance_m = 0.0;            ///< distance travelled then
    std::optional<DrivingState> driving;
    std::optional<std::int64_t> driving_utime;  ///< PhaseClock when `driving` was received
  };

  /// Where the maneuvers lead.
  struct Target {
    std::vector<Eigen::Vector2d> route_odom;
    bool is_straight_ahead = false;  ///< not chosen by exploration
    bool is_known = false;           ///< it began on driven ground when the last scan was requested
  };

  void set_time(std::int64_t utime);
  void enter(Phase phase, const std::string& reason);
  void end(MissionOutcome outcome, const std::string& reason);
  void turn_around(const std::string& reason);
  /// Towards home, on a route of exploration.
  [[nodiscard]] bool is_returning() const;

  void wait_for_stages();
  [[nodiscard]] std::optional<ExploreRequest> explore();
  [[nodiscard]] std::optional<ScanRequest> scan();
  [[nodiscard]] std::optional<PlanGoal> plan();
  void execute();

  void evaluate(const ExplorationReport& report);
  void evaluate(const PlannedPath& path);
  void evaluate(const DrivingState& state);
  void set_target(const ExplorationReport& report);
  [[nodiscard]] std::optional<ExplorationReport> detour_of(const ExplorationReport& report);
  void scan_along(std::vector<Eigen::Vector2d> route_odom, const std::string& reason);
  void scan_straight_ahead(const std::string& reason);
  [[nodiscard]] std::optional<Rejoin> transit(double unscanned_m) const;
  [[nodiscard]] std::optional<Rejoin> known_path() const;
  void request_scan(LaserId laser, const std::string& reason);
  [[nodiscard]] LaserId other_laser() const;
  void handle_arrival();
  void handle_failed_drive(const std::string& reason);

  // mission_recovery.cpp
  void recover(const Recovery::Rejection& rejection);
  [[nodiscard]] Recovery::Options recovery_options(double reached_m) const;
  void begin(Maneuver maneuver, const std::string& reason);
  void back_off(double distance_m, const std::string& reason);
  void rejoin(const std::string& reason);
  void abandon_target();
  bool withdraw(const std::string& reason);
  void retry_near_home(const std::string& reason);
  void end_near_home(const std::string& reason);
  void end_at_home(const std::string& reason);
  void end_scan_at_home(const std::string& reason);
  [[nodiscard]] LaserId laser_as_at_start() const;
  bool end_unmeasured_at_start(const std::string& reason);
  [[nodiscard]] bool can_match_at_home(double uncertainty_m) const;
  void note_progress();
  void note_failed_try(const std::string& reason);
  [[nodiscard]] std::optional<double> rejoin_length_m() const;

  MissionParams params_;
  MissionLimits limits_;
  MissionLocalization localization_;
  RolledDistance rolled_;
  Inputs inputs_;

  MissionPhase phase_;
  PhaseClock clock_;
  std::int32_t explore_id_ = 0;   ///< of the newest explore request
  bool return_is_final_ = false;  ///< by order, limit or power loss

  Target target_;
  Maneuver maneuver_;          ///< in phases plan and execute
  double path_moved_m_ = 0.0;  ///< by map corrections since it was chosen
  Recovery recovery_;
  Retracing retracing_;
  ProgressChecker progress_;
  HomewardProgress homeward_progress_;
  HomewardDetour homeward_detour_;
  HomeArrival home_arrival_;
  /// Before each drive near home for new matches with the local maps there, see end_at_home().
  std::vector<double> home_uncertainties_m_;
  bool looks_at_home_ = false;    ///< stands there until mapping has matched what it sees
  bool scans_at_home_ = false;    ///< the present 3D scan is to be compared with that of the start
  bool scanned_at_home_ = false;  ///< since it came home
  std::optional<BlockedVerdict> verdict_;  ///< for the next explore request
  double slope_ = 0.0;         ///< of the ground under the body, by the last match [m/m]
  double unlevelled_m_ = 0.0;  ///< distance travelled with unknown roll and pitch
  int scan_tries_ = 0;         ///< for the present route
  int failed_tries_ = 0;       ///< in a row, without a path
};

}  // namespace adit
