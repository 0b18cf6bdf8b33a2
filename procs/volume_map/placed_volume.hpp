// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/geometry/level_pose.hpp"
#include "common/types/cloud.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {

/// An odom frame, anchored to the newest local map that was made in it.
struct AnchoredOdom {
  static constexpr std::int64_t kNoEnd = std::numeric_limits<std::int64_t>::max();

  std::int64_t begin_utime = 0;  ///< 0: unknown [µs since the epoch]
  std::int64_t end_utime = kNoEnd;
  int session = 0;
  int local_map = 0;  ///< id
  LevelPose T_local_odom;

  /// Whether a measurement of this time was taken in it.
  [[nodiscard]] bool has(std::int64_t utime) const {
    return begin_utime <= utime && utime < end_utime;
  }

  friend bool operator==(const AnchoredOdom&, const AnchoredOdom&) = default;
};

/// A sub-volume and its pose.
struct PlacedVolume {
  /// The local map with which it moves.
  struct Anchor {
    int local_map = 0;  ///< id
    LevelPose T_local_volume;
  };

  SubVolume volume;
  LevelPose T_odom_volume;         ///< level of its first scan
  std::optional<Anchor> anchor;    ///< empty before the first pose graph
  LevelPose T_map_volume;          ///< without an anchor odom serves as map
  bool excluded = false;           ///< its pose in map cannot be determined
  int replacements = 0;            ///< how often its scans were replaced
  LevelPose T_volume_viewpoint{};  ///< viewpoint of its first scan; see is_same_viewpoint()
  bool departed = false;           ///< the robot has scanned from elsewhere since
};

/// A placed volume as it is stored.
struct StoredVolume {
  VolumeContents contents;
  LevelPose T_odom_volume;
  std::optional<PlacedVolume::Anchor> anchor;
  LevelPose T_volume_viewpoint{};
};
StoredVolume stored(const PlacedVolume& placed);

// Replacement. Where a mine is traversed repeatedly, a new scan replaces all older ones from within
// `replace_radius_m` of it with the same heading. Replacing only the nearest one would fill the
// mine up to the densest packing (random sequential adsorption), which takes arbitrarily long, as
// the remaining gaps are hit ever more rarely. With this rule viewpoints are removed as often as
// they are added, and their number settles after a few rounds: one per 2 `replace_radius_m` of
// tunnel and heading.
//
// Scans of one visit are an exception, otherwise each would replace the one before it and a drive
// would leave nothing behind: a viewpoint that the robot has not departed from keeps its position,
// and a scan farther from it than `replace_radius_m` makes another one.

/// Viewpoint and heading of a scan in level: its lasers are at the ends of the body and face
/// outwards.
[[nodiscard]] LevelPose viewpoint_of(const Cloud& cloud);

/// Both poses must be in the same frame. Distances are in space: on another level is elsewhere.
[[nodiscard]] bool is_same_viewpoint(const LevelPose& T_a, const LevelPose& T_b,
                                     double replace_radius_m);

/// Marks the volumes farther than `replace_radius_m` from the new viewpoint as departed.
void mark_departed(std::vector<PlacedVolume>& volumes, const LevelPose& T_map_viewpoint,
                   double replace_radius_m);

/// Indices of the volumes to replace: first the one of this visit, the nearest if there are
/// several, then all departed ones.
[[nodiscard]] std::vector<std::size_t> volumes_to_replace(const std::vector<PlacedVolume>& volumes,
                                                          const LevelPose& T_map_viewpoint,
                                                          double replace_radius_m);

}  // namespace adit
