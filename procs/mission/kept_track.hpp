// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "procs/mission/own_track.hpp"

namespace adit {

/// A place of the own track, as it is kept on the disk.
struct KeptPlace {
  std::int64_t odom_utime = 0;  ///< when its odom frame began [µs since the epoch]
  Pose2 T_odom_body;
  std::optional<Pose2> T_map_odom;  ///< as far as it was known there
  bool tied = false;                ///< so well that the way before leads on from there

  friend bool operator==(const KeptPlace&, const KeptPlace&) = default;
};

/// The same bits on machines of one byte order.
std::vector<std::uint8_t> to_bytes(const KeptPlace& place);
/// Nothing where these are no such bytes.
std::optional<KeptPlace> kept_place_from(std::span<const std::uint8_t> bytes);

/// The track that these places were, in the odom frame of the last one.
OwnTrack track_of(const std::vector<KeptPlace>& places);

}  // namespace adit
