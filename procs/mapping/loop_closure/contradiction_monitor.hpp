// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/map_contradictions.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "procs/mapping/loop_closure/loop_closure_candidates.hpp"
#include "procs/mapping/loop_closure/map_matching.hpp"
#include "procs/mapping/loop_closure/wall_store.hpp"

namespace adit {

/// The likelihood of the map where local maps overlap (paper, section 2.3), with and without loop
/// closures between them: of all pairs, those of which one has walls where the other observed free
/// space. A pair is compared again when its relative pose has changed by more than 0.1 m or
/// 0.02 rad, so that the cost follows from what changed; a local map with the 24 nearest older ones
/// that it overlaps, so that it does not grow with the number of times a place is passed. Only
/// local maps whose walls were observed at one height take part: where the body pitches and rolls,
/// right maps show different sections of rough walls, ground and roof.
class ContradictionMonitor {
 public:
  /// Whether two local maps may show the same ground at T_older_newer.
  using SameLevel = std::function<bool(int older, int newer, const Pose2& T_older_newer)>;

  /// A local map and its neighbours in the chain, at their poses in its frame; itself first.
  using WallsAround = std::function<std::vector<PlacedWalls>(int map)>;

  /// `evidence_min`: of a contradiction, −2 log-likelihood ratio.
  ContradictionMonitor(const MapMatchingParams& params, double evidence_min)
      : params_(params), evidence_min_(evidence_min) {}

  /// Compares the local maps at these poses. Walls and extents of a map must not change.
  void update(const WallStore& walls, std::span<const MapExtent> extents,
              std::span<const Pose2> T_map_local, const WallsAround& walls_around,
              const SameLevel& same_level);

  /// In order of the newer, then the older map.
  [[nodiscard]] const std::vector<MapContradiction>& contradictions() const {
    return contradictions_;
  }

 private:
  /// An older map that may overlap, and T_older_newer when they were compared, in single precision:
  /// there are many.
  struct Compared {
    std::int32_t older;
    std::array<float, 3> T_older_newer;
  };
  struct Suspicion {
    Pose2 T_older_newer;  ///< when compared
    double evidence = 0.0;
  };

  [[nodiscard]] std::vector<std::size_t> nearest_older(std::size_t newer,
                                                       std::span<const std::size_t> all,
                                                       std::span<const MapExtent> extents,
                                                       std::span<const Pose2> T_map_local);
  [[nodiscard]] std::vector<std::size_t> moved_older(std::size_t newer,
                                                     std::span<const std::size_t> moved) const;
  void compare(std::size_t older, std::size_t newer, const WallStore& walls,
               std::span<const MapExtent> extents, const Pose2& T_older_newer,
               const WallsAround& walls_around);
  [[nodiscard]] double evidence(std::vector<PlacedWalls> older, const LocalWalls& newer,
                                const Pose2& T_older_newer) const;

  MapMatchingParams params_;
  double evidence_min_;
  std::vector<bool> is_level_;                   ///< of each map
  std::vector<Pose2> compared_at_;               ///< T_map_local of each map
  std::vector<std::vector<Compared>> compared_;  ///< of each newer map, in order of the older
  std::map<std::pair<int, int>, Suspicion> suspected_;  ///< (newer, older) with enough evidence
  std::vector<MapContradiction> contradictions_;
};

}  // namespace adit
