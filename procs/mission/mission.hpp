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
#include "common/exploration/exploration_report.hpp"
#include "common/mission/explore_request.hpp"
#include "common/mission/mission_order.hpp"
#include "common/mission/mission_phase.hpp"
#include "common/path/driving_state.hpp"
#include "common/path/planned_path.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/ground_and_air.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/sensing/scan_request.hpp"
#include "common/vehicle/drive_command.hpp"
#include "procs/mission/attempt.hpp"
#include "procs/mission/kept_track.hpp"
#include "procs/mission/mission_limits.hpp"
#include "procs/mission/own_track.hpp"
#include "procs/mission/path_ends.hpp"
#include "procs/mission/refused_places.hpp"
#include "procs/mission/way_home.hpp"

namespace adit {

struct MissionParams {
  MissionLimitsParams limits;
  std::string start = "at_once";       ///< or "by_order": not before a person says so
  std::string after_cut_off = "home";  ///< or "go_on": what to do when the whole computer was off
  double back_off_m = 3.0;             ///< for another look where no path was found
  double relocalise_s = 30.0;          ///< to wait for the map in a new odom frame
  double stay_s = 30.0;                ///< to wait for exploration to know where to go
  int lost_tries_max = 10;             ///< without a way on, before it is stranded
  double nearly_home_m = 0.5;  ///< from the start; it is home there if it can get no nearer,
  int nearly_home_tries = 2;   ///< after so many tries

  template <class V>
  void visit(V& v) {
    v("limits", limits);
    v("start", start, OneOf({"at_once", "by_order"}));
    v("after_cut_off", after_cut_off, OneOf({"home", "go_on"}));
    v("back_off_m", back_off_m, within(0.5, 10.0));
    v("relocalise_s", relocalise_s, within(0.0, 600.0));
    v("stay_s", stay_s, within(0.0, 600.0));
    v("lost_tries_max", lost_tries_max, at_least(1));
    v("nearly_home_m", nearly_home_m, within(0.0, 10.0));
    v("nearly_home_tries", nearly_home_tries, at_least(0));
  }
};

/// What the mission asks of the stages; each repeated until it is answered.
struct MissionAsk {
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

  /// Goes on from where an earlier life was; `begun_utime` is when the mission began.
  /// `track`: the places of its own track, in the order of the way.
  void restore(const MissionPhase& last, std::int64_t begun_utime,
               std::vector<KeptPlace> track = {});

  /// A place that is to be kept, if there is a new one.
  std::optional<KeptPlace> add_pose(std::int64_t utime, const Pose2& T_odom_body);
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
  MissionAsk advance(std::int64_t utime);

  [[nodiscard]] const MissionPhase& phase() const { return phase_; }
  [[nodiscard]] std::int64_t begun_utime() const { return begun_utime_; }

 private:
  void take_up_track();
  void enter(Phase phase, const std::string& reason);
  void end(MissionOutcome outcome, const std::string& reason);
  void turn_around(const std::string& reason);
  [[nodiscard]] double since_phase_s() const;
  [[nodiscard]] bool is_time_to_ask(double period_s);
  [[nodiscard]] bool moves() const { return phase_.phase == Phase::kExecute; }

  void wait(MissionAsk& ask);
  void explore(MissionAsk& ask);
  void scan(MissionAsk& ask);
  void plan(MissionAsk& ask);
  void execute();

  void decide(const ExplorationReport& report);
  void go_by_sight(const std::string& reason);
  void look_along(std::vector<Eigen::Vector2d> route_odom, const std::string& reason);
  [[nodiscard]] bool is_led_home() const { return phase_.homeward && !by_sight_; }
  [[nodiscard]] bool is_short_cut_home(double reached_m) const;
  [[nodiscard]] bool is_nearly_home() const;
  void refuse_nearly_home(const std::string& reason);
  void end_nearly_home(const std::string& reason);
  void look(LaserId laser, const std::string& reason);
  void judge(const PlannedPath& path);
  void refuse(double reached_m, const std::string& reason, Attempt::Evidence evidence);
  void drive_failed(const std::string& reason);
  void go_nearer(double reached_m, const std::string& reason);
  void back_off(double distance_m, const std::string& reason);
  void back_off_as_planned(const std::string& reason);
  void take_track_as_believed();
  [[nodiscard]] bool leads_back() const;
  [[nodiscard]] double track_that_leads_there_m() const;
  void rejoin(double length_m, const std::string& reason);
  [[nodiscard]] bool is_beyond_refusals() const;
  void got_on();
  void lost_try(const std::string& reason);
  [[nodiscard]] LaserId facing(const std::vector<Eigen::Vector2d>& route_odom) const;
  [[nodiscard]] PlanGoal goal() const;

  MissionParams params_;
  MissionLimits limits_;
  MissionPhase phase_;
  OwnTrack way_;
  Attempt attempt_;
  std::int64_t utime_ = 0;
  std::int64_t begun_utime_ = 0;
  std::int64_t phase_utime_ = 0;  ///< bus time at which the phase began
  std::int64_t asked_utime_ = 0;  ///< and at which something was last asked
  int tries_ = 0;                 ///< of this phase, with another scan each
  int lost_tries_ = 0;            ///< in a row, with no way on
  double progress_mark_m_ = 0.0;  ///< way at the last look

  bool restored_ = false;
  bool home_for_good_ = false;       ///< by order, limit or cut-off
  bool has_map_ = false;             ///< mapping has said where it is, in the present odom frame
  std::optional<Pose2> T_map_odom_;  ///< of the present odom frame
  std::int64_t odom_utime_ = 0;      ///< when the present odom frame began
  std::int64_t restored_utime_ = 0;  ///< of the last change of phase before a restart
  /// Until it is known in which odom frame the robot is.
  std::vector<KeptPlace> restored_track_;
  bool odom_is_new_ = false;  ///< it is not the first of the mission
  std::int32_t request_ = 0;  ///< id of the last that exploration was asked
  std::optional<BlockedVerdict> verdict_;
  std::vector<Eigen::Vector2d> route_odom_;  ///< to the target
  PlanGoal::Kind goal_kind_ = PlanGoal::Kind::kRoute;
  std::optional<Eigen::Vector2d> p_odom_home_;  ///< where the route ends, if that is home
  int nearly_home_tries_ = 0;
  WayHome way_home_;
  bool by_sight_ = false;          ///< no target of exploration
  std::vector<Pose2> track_odom_;  ///< to go back on
  /// The same where it backs off, instead of the route to the target.
  std::vector<Eigen::Vector2d> route_back_odom_;
  double goal_distance_m_ = 0.0;
  double nearer_m_ = 0.0;  ///< along the route, where it only goes to see more
  bool backing_off_ = false;
  bool track_failed_ = false;   ///< the last drive on the own track
  int rejoined_ = 0;            ///< how often it went to the own track, for one target
  std::set<int> narrow_stubs_;  ///< to which a look said that the way is only just too narrow
  RefusedPlaces refused_;
  PathEnds path_ends_;
  std::int64_t terrain_utime_ = 0;
  std::optional<DrivingState> driving_;
  std::int64_t driving_utime_ = 0;
};

}  // namespace adit
