// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {

/// An odom frame by the newest local map that was made in it.
struct AnchoredOdom {
  static constexpr std::int64_t kNoEnd = std::numeric_limits<std::int64_t>::max();

  std::int64_t begin_utime = 0;  ///< 0: not known [µs since the epoch]
  std::int64_t end_utime = kNoEnd;
  int session = 0;
  int local_map = 0;  ///< id
  Pose2 T_local_odom;

  /// Whether what was taken then was taken in it.
  [[nodiscard]] bool has(std::int64_t utime) const {
    return begin_utime <= utime && utime < end_utime;
  }

  friend bool operator==(const AnchoredOdom&, const AnchoredOdom&) = default;
};

/// A sub-volume and where it is.
struct PlacedVolume {
  /// By which it moves with the pose graph.
  struct Anchor {
    int local_map = 0;  ///< id
    Pose2 T_local_volume;
  };

  SubVolume volume;
  Pose2 T_odom_volume;           ///< when its first scan was taken
  std::optional<Anchor> anchor;  ///< nothing before the first pose graph
  Pose2 T_map_volume;            ///< without a tie odom stands for map
  bool excluded = false;         ///< nobody knows where it is
  int replacements = 0;          ///< how often what was seen before was forgotten
  Pose2 T_volume_viewpoint{};    ///< where its first look is from, and which way; see renewal.hpp
  bool departed = false;         ///< since then there was a look from elsewhere
};

/// One as it is kept.
struct StoredVolume {
  VolumeContents contents;
  Pose2 T_odom_volume;
  std::optional<PlacedVolume::Anchor> anchor;
  Pose2 T_volume_viewpoint{};
};
StoredVolume stored(const PlacedVolume& placed);

}  // namespace adit
