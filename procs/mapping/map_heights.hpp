// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/pose_graph/height_field.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "common/types/cloud_match.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "procs/mapping/loop_closure/wall_store.hpp"

namespace adit {

struct MapHeightsParams {
  double floor_m = 0.02;             ///< minimum standard deviation of the climb of a local map,
  double drift_per_m = 0.002;        ///< and its growth with the distance travelled
  double ground_drift_per_m = 0.02;  ///< without an IMU, by the ground that 3D scans showed
  double slope_max = 0.35;  ///< of ground; with unknown attitude the climb is unknown up to this
  double scan_m = 0.01;     ///< minimum of that from the origin of a local map to a 3D scan
  double pitch_sd_rad = 0.005;  ///< of the constant errors of pitch and roll of a session
  double ground_sd_m = 0.02;    ///< of the ground at a place where two local maps meet,
  double ground_slope = 0.2;    ///< and its growth with the distance between their paths
  double level_m = 1.0;         ///< local maps whose ground is farther apart show different levels

  template <class V>
  void visit(V& v) {
    v("floor_m", floor_m, above(0.0));
    v("drift_per_m", drift_per_m, at_least(0.0));
    v("ground_drift_per_m", ground_drift_per_m, at_least(0.0));
    v("slope_max", slope_max, above(0.0));
    v("scan_m", scan_m, above(0.0));
    v("pitch_sd_rad", pitch_sd_rad, above(0.0));
    v("ground_sd_m", ground_sd_m, above(0.0));
    v("ground_slope", ground_slope, at_least(0.0));
    v("level_m", level_m, above(0.0));
  }
};

/// The heights of all local maps in map. In the chain they follow from the climb of each local map,
/// at a loop closure from the ground that both local maps drove on. Where two 3D scans were matched
/// they follow from floor and roof: a body that drives over rubble rises and sinks as a whole,
/// which its pitch does not show. The 3D scans are nodes of their own, between which the climb of a
/// local map has no part.
class MapHeights {
 public:
  explicit MapHeights(const MapHeightsParams& params)
      : params_(params), field_(params.pitch_sd_rad) {}

  /// What the 3D scans of a session tell of the constant error of its attitude; otherwise
  /// `pitch_sd_rad`. It takes effect with the next change.
  void set_tilt_prior(int session, const TiltPrior& prior) {
    field_.set_tilt_prior(session, prior);
  }

  /// Adds a place where a 3D scan was taken, before its local map is added.
  void add(const CloudPlace& place);
  /// Adds what a match tells, before the newer of its local maps is added or with the places of its
  /// 3D scans known. It counts while its loop closure is in force.
  void add(const CloudMatch& match);
  /// The matches of the 3D scans of a local map with earlier ones, in the order in which they were
  /// added.
  [[nodiscard]] const std::vector<CloudMatch>& matches_of(int newer_map) const;
  /// The match of 3D scans that a loop closure is; nullptr if it is none that was added.
  [[nodiscard]] const CloudMatch* match_of(const PoseConstraint& loop_closure) const;
  [[nodiscard]] bool is_match(const PoseConstraint& loop_closure) const {
    return match_of(loop_closure) != nullptr;
  }

  /// Adds the local maps that are new.
  void add_new(const std::vector<LocalMap>& maps);
  /// Solves for the heights, with these loop closures in force, at the cost of what differs from
  /// the last time. A local map does not change while it is there.
  void update(const std::vector<LocalMap>& maps, const WallStore& walls,
              const std::vector<PoseConstraint>& loop_closures);

  /// Height of the origin of a local map above that of the first [m].
  [[nodiscard]] double height_m(int map) const { return field_.height_m(node_of(map)); }
  /// Variance of the height of one local map above another [m²].
  [[nodiscard]] double variance(int from, int to) const {
    return field_.variance(node_of(from), node_of(to));
  }
  /// Variance of the heights of all local maps relative to one of them [m²].
  [[nodiscard]] Eigen::VectorXd variances_to(int map) const;

  /// Whether two local maps may show the same ground at this relative pose: not if their paths,
  /// where they are nearest to each other, are farther apart in height than ground and the
  /// uncertainty of the heights allow.
  [[nodiscard]] bool same_level(int older, int newer, const Pose2& T_older_newer,
                                const WallStore& walls) const;

 private:
  [[nodiscard]] double drift_per_m(const LocalMap& map) const;
  [[nodiscard]] HeightConstraint climb_of(const LocalMap& map, const LocalMap& before) const;
  [[nodiscard]] const GroundOffset& offset_at(const PoseConstraint& loop_closure,
                                              const WallStore& walls);

  void add_climbs(const std::vector<LocalMap>& maps);
  void add_scans(const LocalMap& map);
  [[nodiscard]] std::optional<int> node_of(const CloudPlace& place) const;
  [[nodiscard]] double scan_sd_m(const LocalMap& map, const CloudPlace& place) const;
  void remove_newest_map();
  [[nodiscard]] int node_of(int map) const { return maps_[static_cast<std::size_t>(map)].node; }
  [[nodiscard]] int add_to_field(const CloudMatch& match, int session);
  [[nodiscard]] int add_to_field(const PoseConstraint& loop_closure,
                                 const std::vector<LocalMap>& maps, const WallStore& walls);

  /// A loop closure in force, and its constraint in the field; −1 without common ground.
  struct LoopClosureInForce {
    int from = 0;
    int to = 0;
    Pose2 T_from_to;
    int constraint = -1;
  };

  MapHeightsParams params_;
  HeightField field_;
  /// A local map or a 3D scan in the field, and the constraint to the local map before, or of the
  /// scan; −1 for the first local map.
  struct Node {
    int node = 0;
    int constraint = -1;
  };
  std::vector<Node> maps_;
  struct Scan {
    CloudPlace place;
    std::optional<Node> node;  ///< none until its local map is added
  };
  std::map<int, std::vector<Scan>> scans_;          ///< by local map
  std::map<int, std::vector<CloudMatch>> matches_;  ///< by newer local map
  std::vector<LoopClosureInForce> loop_closures_;
  struct Offset {
    Pose2 T_from_to;
    GroundOffset ground;
  };
  std::map<std::array<int, 2>, Offset> offsets_;  ///< of loop closures, by local maps
};

}  // namespace adit
