// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/exploration.hpp"
#include "common/types/mission.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle_state.hpp"
#include "procs/mission/mission_limits.hpp"
#include "procs/mission/progress_checker.hpp"
#include "procs/mission/retry_policy.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {

struct MissionParams {
  MissionLimitsParams limits;
  std::string start = "immediately";  ///< or "on_order": not before a person says so
  std::string after_power_loss =
      "home";                           ///< or "resume": what to do when the whole computer was off
  double back_off_m = 3.0;              ///< for another look where no path was found
  double relocalization_wait_s = 30.0;  ///< to wait for the map in a new odom frame
  double exploration_wait_s = 30.0;     ///< to wait for exploration to know where to go
  int failed_tries_max = 10;            ///< without a way on, before it is stranded
  double home_tolerance_m = 0.5;  ///< from the start; it is home there if it can get no nearer,
  int home_retries = 2;           ///< after so many tries

  template <class V>
  void visit(V& v) {
    v("limits", limits);
    v("start", start, OneOf({"immediately", "on_order"}));
    v("after_power_loss", after_power_loss, OneOf({"home", "resume"}));
    v("back_off_m", back_off_m, within(0.5, 10.0));
    v("relocalization_wait_s", relocalization_wait_s, within(0.0, 600.0));
    v("exploration_wait_s", exploration_wait_s, within(0.0, 600.0));
    v("failed_tries_max", failed_tries_max, at_least(1));
    v("home_tolerance_m", home_tolerance_m, within(0.0, 10.0));
    v("home_retries", home_retries, at_least(0));
  }
};

/// What the mission asks of the stages; each repeated until it is answered.
struct MissionRequests {
  std::optional<ExploreRequest> explore;
  std::optional<ScanRequest> scan;
  std::optional<PlanGoal> goal;
};

/// The sequence of a mission: explore, scan, plan, execute, from the start into the mine and home
/// again (the paper's section 3). It knows no map and no terrain; it asks those who do, judges
/// their answers, and decides when to turn around. Nothing it waits for is waited for for ever.
class Mission {
 public:
  explicit Mission(const MissionParams& params) : params_(params), limits_(params.limits) {}

  /// Goes on from where an earlier life was; `start_utime` is when the mission began.
  /// `track`: the places of its own track, in the order of the way.
  void restore(const MissionPhase& last, std::int64_t start_utime,
               std::vector<StoredPathPose> track = {});

  /// A place that is to be kept, if there is a new one.
  std::optional<StoredPathPose> add_pose(std::int64_t utime, const Pose2& T_odom_body);
  void add_match(const ScanMatch& match);
  void add_correction(const MapCorrection& correction);
  void add_exploration(const ExplorationReport& report);
  void add_cloud(std::int32_t id, bool complete);
  void add_terrain(std::int64_t utime, std::int32_t id);
  void add_path(const PlannedPath& path);
  void add_driving(const DrivingState& state);
  void add_order(const MissionOrder& order);
  [[nodiscard]] MissionLimits& limits() { return limits_; }

  /// Lets time go on: what is to be asked now. To be called some ten times per second.
  MissionRequests advance(std::int64_t utime);

  [[nodiscard]] const MissionPhase& phase() const { return phase_; }
  [[nodiscard]] std::int64_t start_utime() const { return start_utime_; }

 private:
  void restore_path();
  void enter(Phase phase, const std::string& reason);
  void end(MissionOutcome outcome, const std::string& reason);
  void turn_around(const std::string& reason);
  [[nodiscard]] double since_phase_s() const;
  [[nodiscard]] bool request_is_due(double period_s);
  [[nodiscard]] bool moves() const { return phase_.phase == Phase::kExecute; }

  void wait(MissionRequests& requests);
  void explore(MissionRequests& requests);
  void scan(MissionRequests& requests);
  void plan(MissionRequests& requests);
  void execute();

  void decide(const ExplorationReport& report);
  void scan_straight_ahead(const std::string& reason);
  void scan_along(std::vector<Eigen::Vector2d> route_odom, const std::string& reason);
  [[nodiscard]] bool is_returning() const { return phase_.returning_home && !without_target_; }
  [[nodiscard]] bool is_short_cut_home(double reached_m) const;
  [[nodiscard]] bool is_near_home() const;
  void retry_near_home(const std::string& reason);
  void end_near_home(const std::string& reason);
  void request_scan(LaserId laser, const std::string& reason);
  void evaluate_path(const PlannedPath& path);
  void reject(double reached_m, const std::string& reason, RetryPolicy::Evidence evidence);
  void drive_failed(const std::string& reason);
  void approach(double reached_m, const std::string& reason);
  void back_off(double distance_m, const std::string& reason);
  void back_off_by_planning(const std::string& reason);
  void anchor_path_to_estimate();
  [[nodiscard]] bool path_leads_back() const;
  [[nodiscard]] double rejoin_length_m() const;
  void rejoin(double length_m, const std::string& reason);
  [[nodiscard]] bool is_beyond_rejections() const;
  void note_progress();
  void note_failed_try(const std::string& reason);
  [[nodiscard]] LaserId facing(const std::vector<Eigen::Vector2d>& route_odom) const;
  [[nodiscard]] PlanGoal goal() const;

  MissionParams params_;
  MissionLimits limits_;
  MissionPhase phase_;
  TraversedPath traversed_path_;
  RetryPolicy retry_policy_;
  std::int64_t utime_ = 0;
  std::int64_t start_utime_ = 0;
  std::int64_t phase_utime_ = 0;          ///< bus time at which the phase began
  std::int64_t requested_utime_ = 0;      ///< and at which something was last asked
  int scan_tries_ = 0;                    ///< of this phase, with another scan each
  int failed_tries_ = 0;                  ///< in a row, with no way on
  double distance_at_last_scan_m_ = 0.0;  ///< way at the last look

  bool restored_ = false;
  bool return_is_final_ = false;       ///< by order, limit or cut-off
  bool has_map_ = false;               ///< mapping has said where it is, in the present odom frame
  std::optional<Pose2> T_map_odom_;    ///< of the present odom frame
  std::int64_t odom_epoch_utime_ = 0;  ///< when the present odom frame began
  std::int64_t restored_utime_ = 0;    ///< of the last change of phase before a restart
  /// Until it is known in which odom frame the robot is.
  std::vector<StoredPathPose> restored_path_;
  bool odom_is_new_ = false;  ///< it is not the first of the mission
  std::int32_t request_ = 0;  ///< id of the last that exploration was asked
  std::optional<BlockedVerdict> verdict_;
  std::vector<Eigen::Vector2d> route_odom_;  ///< to the target
  PlanGoal::Kind goal_kind_ = PlanGoal::Kind::kRoute;
  std::optional<Eigen::Vector2d> p_odom_home_;  ///< where the route ends, if that is home
  int home_retries_ = 0;
  HomewardProgress homeward_progress_;
  bool without_target_ = false;        ///< no target of exploration
  std::vector<Pose2> path_back_odom_;  ///< to go back on
  /// The same where it backs off, instead of the route to the target.
  std::vector<Eigen::Vector2d> route_back_odom_;
  double goal_distance_m_ = 0.0;
  double approach_m_ = 0.0;  ///< along the route, where it only goes to see more
  bool backing_off_ = false;
  bool path_back_failed_ = false;   ///< the last drive on the own track
  int rejoin_count_ = 0;            ///< how often it went to the own track, for one target
  std::set<int> narrow_frontiers_;  ///< to which a look said that the way is only just too narrow
  RejectedPlaces rejected_;
  PathEnds path_ends_;
  std::int64_t terrain_utime_ = 0;
  std::optional<DrivingState> driving_;
  std::int64_t driving_utime_ = 0;
};

}  // namespace adit
