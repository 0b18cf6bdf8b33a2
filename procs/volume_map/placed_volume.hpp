// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {

/// An odom frame, anchored to the newest local map that was made in it.
struct AnchoredOdom {
  static constexpr std::int64_t kNoEnd = std::numeric_limits<std::int64_t>::max();

  std::int64_t begin_utime = 0;  ///< 0: unknown [µs since the epoch]
  std::int64_t end_utime = kNoEnd;
  int session = 0;
  int local_map = 0;  ///< id
  Pose2 T_local_odom;

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
    Pose2 T_local_volume;
  };

  SubVolume volume;
  Pose2 T_odom_volume;           ///< level of its first scan
  std::optional<Anchor> anchor;  ///< empty before the first pose graph
  Pose2 T_map_volume;            ///< without an anchor odom serves as map
  bool excluded = false;         ///< its pose in map cannot be determined
  int replacements = 0;          ///< how often its scans were replaced
  Pose2 T_volume_viewpoint{};    ///< viewpoint of its first scan; see scan_replacement.hpp
  bool departed = false;         ///< the robot has scanned from elsewhere since
};

/// A placed volume as it is stored.
struct StoredVolume {
  VolumeContents contents;
  Pose2 T_odom_volume;
  std::optional<PlacedVolume::Anchor> anchor;
  Pose2 T_volume_viewpoint{};
};
StoredVolume stored(const PlacedVolume& placed);

}  // namespace adit
