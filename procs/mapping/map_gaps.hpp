// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/types/local_map.hpp"

namespace adit {

/// What a damaged journal has lost of a map.
struct MapLosses {
  std::vector<int> local_maps;  ///< ids; an empty local map is in the place of each
  std::vector<int> shortened;   ///< ids of local maps without some of their scans
  int loop_closures = 0;        ///< decisions on loop closures
  bool end = false;             ///< an unknown number of local maps at the end

  /// Whether the chain has a gap, so that the place of what follows is uncertain.
  [[nodiscard]] bool has_gap() const { return end || !local_maps.empty(); }

  friend bool operator==(const MapLosses&, const MapLosses&) = default;
};

/// In words, e.g. "local maps 7 and 8 lost"; empty if nothing is lost.
std::string text_of(const MapLosses& losses);

/// Information of the pose of a local map in that before [1/m², 1/(m rad), 1/rad²] where the path
/// between them was not seen: it is known by odom over this distance, or not at all.
Eigen::Matrix3d information_across_gap(double unseen_m);
Eigen::Matrix3d information_of_unknown_pose();

/// Takes the place of the lost local map `id`: without scans, where the body was at the end of the
/// local map before (nullptr: where odom began) as the odometry has it. `next`: a later local map,
/// nullptr if there is none.
LocalMap empty_local_map(int id, const LocalMap* before, const LocalMap* next);

/// Links a local map to the empty one before: by odom if it is the same, otherwise its pose is
/// unknown.
void link_after_gap(LocalMap& map, const LocalMap& empty);

}  // namespace adit
