// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/association/lazy_association.hpp"
#include "procs/mapping/local_map_builder.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "procs/mapping/loop_closure/loop_closure_candidates.hpp"
#include "procs/mapping/loop_closure/map_matching.hpp"

namespace adit {

struct MappingParams {
  Lasers lasers;
  LocalMapBuilderParams local_maps;
  LocalWallsParams walls;
  LoopClosureCandidatesParams candidates;
  MapMatchingParams matching;
  LazyAssociationParams association;
  bool carried = false;  ///< where odom begins anew, the body may be anywhere; else where it was
  double restart_sd_m = 1.0;    ///< of the way between what is stored and where it then is, about
  double restart_sd_rad = 0.5;  ///< of its turning
  /// A local map that lies on so many older ones and shows nothing new is not kept: it says where
  /// the body is, and is forgotten. 0: all are kept.
  int maps_per_place_max = 0;

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v("local_maps", local_maps);
    v("walls", walls);
    v("candidates", candidates);
    v("matching", matching);
    v("association", association);
    v("carried", carried);
    v("restart_sd_m", restart_sd_m, within(0.01, 100.0));
    v("restart_sd_rad", restart_sd_rad, within(0.01, 3.2));
    v("maps_per_place_max", maps_per_place_max, within(0, 1000));
  }
};

/// A map as it is kept: all local maps, and every decision in the order in which it was made.
struct StoredMap {
  std::vector<LocalMap> maps;
  std::vector<Association> associations;
  std::optional<LocalMap> unfinished;  ///< the one that was being made, as far as it is stored
};

/// What a new local map brought.
struct MapUpdate {
  LocalMap map;
  std::vector<Association> associations;  ///< in the order in which they were decided
  bool stored = true;  ///< else it only said where the body is; the graph is as it was
};

/// The map: local maps every few metres of the way, held in place by what was measured between them
/// and by the places that were seen again (paper, sections 2.1 to 2.3). Which places these are is
/// decided lazily.
///
/// Who goes through a mine again and again makes no larger map, where that is asked for: of a place
/// no more than `maps_per_place_max` local maps are kept (a reduced pose graph, after Johannsson,
/// Kaess, Fallon, Leonard, "Temporally scalable visual SLAM using a reduced pose graph", ICRA
/// 2013).
class Mapping : private Evidence {
 public:
  explicit Mapping(const MappingParams& params);

  /// Continues a map, before anything is added. What is added then is a session of its own, joined
  /// to the map where the places are recognised; where odom goes on from where the map ends, it is
  /// looked for near there, and also where it begins anew and the body was not carried.
  /// Something where a local map was being made, which is then one.
  std::optional<MapUpdate> restore(StoredMap stored);

  /// A scan and what scan matching made of it, in order of time. Something where it finished a
  /// local map.
  std::optional<MapUpdate> add(const std::string& channel, const LaserScan& scan,
                               const ScanMatch& match);

  /// The way ends here: what there is of a local map is one.
  std::optional<MapUpdate> finish();

  [[nodiscard]] MapGraph graph() const;
  /// Nothing before the first local map, nor while it is not known where odom is on the map:
  /// between the begin of a new one and its first local map.
  [[nodiscard]] std::optional<MapCorrection> correction() const;
  /// The local map that is being made.
  [[nodiscard]] const LocalMap& unfinished() const { return builder_.current(); }

  [[nodiscard]] const std::vector<LocalMap>& local_maps() const { return maps_; }
  [[nodiscard]] const LazyAssociation& association() const { return association_; }

 private:
  MapUpdate add_local_map(LocalMap map);
  [[nodiscard]] bool is_redundant(const MapUpdate& update) const;
  void discard_newest(MapUpdate& update, LazyAssociation::Checkpoint before);
  void append_map(LocalMap map);
  void link_session(LocalMap& map) const;
  void update_odom(const ScanMatch& match);
  [[nodiscard]] std::optional<Eigen::Matrix3d> covariance_in_older_sessions();
  [[nodiscard]] bool session_is_connected() const;
  [[nodiscard]] bool is_neighbour(int older, int newer) const;
  [[nodiscard]] std::vector<LoopClosure> loop_closures(int map, Trial& trial,
                                                       bool thorough) const override;
  [[nodiscard]] double map_inconsistency(const std::vector<Pose2>& T_map_local) const override;
  [[nodiscard]] std::vector<LoopClosure> relocalise() const;
  [[nodiscard]] std::vector<PlacedWalls> walls_around(int map,
                                                      std::span<const Pose2> T_map_local) const;

  MappingParams params_;
  LaserMounts mounts_;
  LocalMapBuilder builder_;
  LazyAssociation association_;
  std::vector<LocalMap> maps_;
  std::vector<LocalWalls> walls_;
  std::vector<MapExtent> extents_;
  std::int64_t revision_ = 0;
  enum class Odom {
    kKnown,     ///< that of the newest local map
    kRestored,  ///< of the newest local map or a new one: the next scan tells
    kNew,       ///< its first local map is being made
  };
  Odom odom_ = Odom::kKnown;
  std::optional<std::int64_t> odom_epoch_utime_;  ///< when the odom frame of the last scan began
  bool odom_continues_ = false;  ///< a restored map ends in the odom frame of the present session
  std::optional<Eigen::Matrix3d> covariance_;  ///< see MapCorrection
  /// Where a local map that was not kept found the body, after all that are kept.
  struct Localization {
    std::int64_t utime = 0;
    int older_map = 0;  ///< on which it lies
    Pose2 T_map_odom;
  };
  std::optional<Localization> localization_;
};

}  // namespace adit
