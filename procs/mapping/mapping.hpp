// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/journal/journal_recovery.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/association.hpp"
#include "common/types/cloud.hpp"
#include "common/types/cloud_match.hpp"
#include "common/types/local_map.hpp"
#include "common/types/map_contradictions.hpp"
#include "procs/mapping/association/lazy_association.hpp"
#include "procs/mapping/association/session_rivals.hpp"
#include "procs/mapping/displacement_error.hpp"
#include "procs/mapping/joining/run_join.hpp"
#include "procs/mapping/level_error.hpp"
#include "procs/mapping/local_map_builder.hpp"
#include "procs/mapping/local_map_store.hpp"
#include "procs/mapping/loop_closure/cloud_matching.hpp"
#include "procs/mapping/loop_closure/contradiction_monitor.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "procs/mapping/loop_closure/loop_closure_candidates.hpp"
#include "procs/mapping/loop_closure/map_matching.hpp"
#include "procs/mapping/loop_closure/wall_store.hpp"
#include "procs/mapping/map_gaps.hpp"
#include "procs/mapping/map_heights.hpp"

namespace adit {

struct MappingParams {
  Lasers lasers;
  LocalMapBuilderParams local_maps;
  LocalWallsParams walls;
  LoopClosureCandidatesParams candidates;
  MapMatchingParams matching;
  CloudMatchingParams clouds;
  LazyAssociationParams association;
  MapHeightsParams heights;
  bool carried = false;  ///< true: the body may be anywhere after a restart of odom; false: it has
                         ///< not been moved
  /// Standard deviation of the motion between the stored pose and the restart.
  double restart_sd_m = 1.0;
  double restart_sd_rad = 0.5;  ///< and of the turn
  /// A local map that overlaps this many older ones and shows nothing new is discarded after it has
  /// localised the body. 0: all are stored.
  int maps_per_place_max = 0;
  /// Folder for a temporary file with the scans and walls of finished local maps; empty: they are
  /// in memory, so that mapping depends on no disk. Not a key of the configuration.
  std::filesystem::path scratch = {};

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v("local_maps", local_maps);
    v("walls", walls);
    v("candidates", candidates);
    v("matching", matching);
    v("clouds", clouds);
    v("association", association);
    v("heights", heights);
    v("carried", carried);
    v("restart_sd_m", restart_sd_m, within(0.01, 100.0));
    v("restart_sd_rad", restart_sd_rad, within(0.01, 3.2));
    v("maps_per_place_max", maps_per_place_max, within(0, 1000));
  }
};

/// A stored map: all local maps, and every decision in order.
struct StoredMap {
  std::vector<LocalMap> maps;
  std::vector<Association> associations;
  std::vector<CloudMatch> cloud_matches = {};  ///< in order
  std::optional<LocalMap> unfinished = {};     ///< the unfinished local map, as far as it is stored
  MapLosses losses = {};                       ///< by damage of the file
  JournalHealth health = {};                   ///< of the file
};

/// The result of a new local map.
struct MapUpdate {
  LocalMap map;
  std::vector<Association> associations;       ///< in the order of decision
  std::vector<CloudMatch> cloud_matches = {};  ///< of its 3D scans, accepted or not
  /// False: the map only localised the body and is discarded; the graph is unchanged.
  bool stored = true;
};

/// The map: a local map every few metres of the traversed path, in a pose graph of the
/// displacements between them and of loop closures (paper, sections 2.1 to 2.3), which are decided
/// lazily.
///
/// Optionally, repeated traversals do not enlarge the map: at most `maps_per_place_max` local maps
/// of a place are stored (a reduced pose graph, after Johannsson, Kaess, Fallon, Leonard,
/// "Temporally scalable visual SLAM using a reduced pose graph", ICRA 2013).
class Mapping : private Evidence {
 public:
  explicit Mapping(const MappingParams& params);

  /// Continues a stored map; to be called before anything is added. What is added afterwards is a
  /// session of its own, linked to the map by loop closures. If odom continues from the end of the
  /// map, or was reset without the body being moved, the first map is searched near there. Returns
  /// an update if a local map was unfinished, which is then finished. Where the map has lost its
  /// end, the pose of the body relative to home counts as unknown from then on.
  std::optional<MapUpdate> restore(StoredMap stored);

  /// To be called after `restore`: searches loop closures over the gaps of a map that has lost
  /// local maps, as between two sessions. Returns the decisions, in order.
  std::vector<Association> reconnect();

  /// Joins the finished map of another run, by any robot and with any start, to this one: its local
  /// maps are relocalised in this map, each link a hypothesis, and decided by the same lazy
  /// association. A single match is never enough: links must agree at several places along both
  /// runs, at one place only, and the walls must not contradict each other. Otherwise this map
  /// stays as it was. `run` was restored; its own decisions are kept.
  RunJoin join(const Mapping& run, const RunJoinParams& params = {});

  /// Adds a reading of the wheels, with which the displacements by scan matching are compared.
  void add(const WheelOdometry& reading) { builder_.add(reading); }

  /// Adds a 3D scan of the robot at rest, to be matched with others (CloudMatching).
  void add(const Cloud& cloud);

  /// The clock of all sensors was set: times so far cannot be compared with those to come.
  void restart_time();

  /// Adds a scan and its scan match, in order of time. Returns an update if it finishes a local
  /// map.
  std::optional<MapUpdate> add(const std::string& channel, const LaserScan& scan,
                               const ScanMatch& match);

  /// Ends the traversed path: finishes the current local map.
  std::optional<MapUpdate> finish();

  [[nodiscard]] MapGraph graph() const;
  /// Empty before the first local map, and while the pose of odom in map is unknown: from the start
  /// of a new odom frame to its first local map.
  [[nodiscard]] std::optional<MapCorrection> correction() const;
  /// The local maps that contradict each other at the poses of `graph`.
  [[nodiscard]] MapContradictions contradictions() const;
  /// The unfinished local map.
  [[nodiscard]] const LocalMap& unfinished() const { return builder_.current(); }

  [[nodiscard]] const LocalMapStore& local_maps() const { return maps_; }
  /// Matches of the 3D scans of a local map with earlier ones, also those whose loop closures are
  /// not in force.
  [[nodiscard]] const std::vector<CloudMatch>& cloud_matches(int newer_map) const {
    return heights_.matches_of(newer_map);
  }
  [[nodiscard]] const LazyAssociation& association() const { return association_; }

 private:
  MapUpdate add_local_map(LocalMap map);
  void localise_at_rest();
  [[nodiscard]] LocalMap map_at_body() const;
  [[nodiscard]] std::vector<LoopClosure> matches_of_clouds_at(const Pose2& T_current_here);
  [[nodiscard]] std::vector<MatchedClouds> matches_of_clouds(int map, const Pose2& T_newest_map);
  void associate(MapUpdate& update);
  void associate_clouds(MapUpdate& update);
  void add_matches(std::span<const CloudMatch> matches);
  bool place_cloud();
  [[nodiscard]] bool is_redundant(const MapUpdate& update) const;
  void discard_newest(MapUpdate& update, LazyAssociation::Checkpoint before);
  void append_map(LocalMap map);
  void remove_newest_map();
  [[nodiscard]] std::vector<NearMap> within_reach(std::span<const Pose2> T_map_local,
                                                  double tolerance_m,
                                                  const Eigen::Matrix3d& covariance) const;
  void update_heights();
  void update_contradictions();
  void link_session(LocalMap& map) const;
  void update_odom(const ScanMatch& match);
  [[nodiscard]] std::optional<Eigen::Matrix3d> covariance_in_older_sessions();
  void update_covariance_from_first();
  [[nodiscard]] std::vector<WheelScaleError> scale_errors_from_first(int map, int end);
  [[nodiscard]] WheelScaleError scale_error_since_newest() const;
  void update_rivals();
  [[nodiscard]] Eigen::Matrix3d moment_of_rivals(int map) const;
  void widen_to_rivals(int map, std::vector<NearMap>& near) const;
  [[nodiscard]] Eigen::Matrix3d body_covariance() const;
  [[nodiscard]] bool session_is_connected() const;
  [[nodiscard]] bool is_bridged(int first_after_gap) const;
  [[nodiscard]] std::vector<LoopClosure> loop_closures_over_gap(int map, int first_after_gap);
  [[nodiscard]] bool is_neighbour(int older, int newer) const;
  [[nodiscard]] std::vector<LoopClosure> loop_closures(int map, Trial& trial,
                                                       bool thorough) const override;
  [[nodiscard]] std::vector<LoopClosure> matches_of(
      const std::vector<LoopClosureCandidate>& candidates, int map,
      const std::vector<Pose2>& poses) const;
  [[nodiscard]] double map_inconsistency(const std::vector<Pose2>& T_map_local) const override;
  [[nodiscard]] std::vector<std::array<int, 2>> known_contradictions(int last) const;
  [[nodiscard]] std::vector<LoopClosure> relocalise() const;
  [[nodiscard]] std::vector<LoopClosureAlternative> found_anywhere(
      const LocalWalls& newer, int older, const std::vector<Pose2>& poses) const;
  [[nodiscard]] std::vector<PossibleJoin> find_run(const Mapping& run, const RunJoinParams& params,
                                                   RunJoin& join) const;
  [[nodiscard]] RunJoin place_run(const Mapping& run, const PossibleJoin& possible,
                                  const RunJoinParams& params, RunJoin join);
  void append_run(const Mapping& run, RunJoin& join);
  void link_run(std::vector<LoopClosure> agreeing, int first);
  [[nodiscard]] std::vector<LoopClosureCandidate> overlapped(int map, int end) const;
  void compare_walls_of_run(int first, RunJoin& join) const;
  [[nodiscard]] double own_walls_apart_m() const;
  void judge_run(const RunJoinParams& params, RunJoin& join) const;
  [[nodiscard]] Eigen::Matrix3d deformation(int map) const;
  void add_deformations(std::vector<LoopClosure>& loop_closures) const;
  [[nodiscard]] std::vector<PlacedWalls> walls_around(int map,
                                                      std::span<const Pose2> T_map_local) const;

  /// Minimum log-likelihood of a place if the pose is otherwise unknown: wrong places reach about
  /// 8, the correct one mostly has 20 and more.
  static constexpr double kRelocalisedLogLikelihood = 15.0;

  MappingParams params_;
  LaserMounts mounts_;
  LocalMapBuilder builder_;
  LazyAssociation association_;
  std::vector<SessionRival> rivals_;
  LocalMapStore maps_;
  WallStore walls_;
  std::vector<MapExtent> extents_;
  std::vector<double> reach_m_;  // of the extents
  MapHeights heights_;
  CloudMatching clouds_;
  std::map<int, LevelError> level_errors_;  ///< by session
  std::optional<Cloud> new_cloud_;  ///< until the next scan shows in which local map it was taken
  ContradictionMonitor contradictions_;
  std::int64_t revision_ = 0;
  enum class Odom {
    kKnown,     ///< that of the newest local map
    kRestored,  ///< of the newest local map or a new one: decided at the next scan
    kNew,       ///< its first local map is unfinished
  };
  Odom odom_ = Odom::kKnown;
  std::optional<std::int64_t> odom_epoch_utime_;  ///< epoch of the odom frame of the last scan
  bool end_is_lost_ = false;     ///< of a map that was restored from a damaged journal
  std::vector<int> lost_;        ///< ids of local maps that a damaged journal has lost
  bool odom_continues_ = false;  ///< the restored map ends in the odom frame of the present session
  std::optional<Eigen::Matrix3d> covariance_;  ///< see MapCorrection
  /// Of the newest local map relative to local map 0, in the frame of the newest.
  Eigen::Matrix3d covariance_from_first_ = Eigen::Matrix3d::Zero();
  /// Effects of the scale of the wheels on that pose, in the same frame.
  std::vector<WheelScaleError> scale_errors_from_first_;
  /// The pose of the body by a discarded local map, later than all stored ones.
  struct Localization {
    std::int64_t utime = 0;
    int older_map = 0;  ///< on which it lies
    Pose2 T_map_odom;
    double z_map_odom_m = 0.0;
  };
  std::optional<Localization> localization_;
  /// Where the body rests near home, from a match of what it sees there; until it moves.
  struct Rest {
    Pose2 T_map_odom;
    Eigen::Matrix3d body_covariance;  ///< as in MapCorrection
  };
  std::optional<Rest> at_rest_;
  std::int64_t rest_utime_ = 0;  ///< of the last stored scan
  bool rested_ = false;          ///< localised since then, or tried
};

}  // namespace adit
