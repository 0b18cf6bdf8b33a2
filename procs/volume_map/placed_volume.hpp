// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/geometry/pose2.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {

/// A sub-volume and where it is.
struct PlacedVolume {
  /// By which it moves with the pose graph.
  struct Tie {
    int local_map = 0;  ///< id
    Pose2 T_local_volume;
  };

  SubVolume volume;
  Pose2 T_odom_volume;     ///< when its first scan was taken
  std::optional<Tie> tie;  ///< nothing before the first pose graph
  Pose2 T_map_volume;      ///< without a tie odom stands for map
  bool left_out = false;   ///< nobody knows where it is
  int renewals = 0;        ///< how often what was seen before was forgotten
  Pose2 T_volume_place{};  ///< where its first look is from, and which way; see renewal.hpp
  bool was_left = false;   ///< since then there was a look from elsewhere
};

/// One as it is kept.
struct StoredVolume {
  VolumeContents contents;
  Pose2 T_odom_volume;
  std::optional<PlacedVolume::Tie> tie;
  Pose2 T_volume_place{};
};
StoredVolume stored(const PlacedVolume& placed);

}  // namespace adit
