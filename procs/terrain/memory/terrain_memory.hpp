// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "procs/terrain/memory/driven_path.hpp"
#include "procs/terrain/memory/height_alignment.hpp"
#include "procs/terrain/memory/remembered_map.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// What became of a map when it was filled from memory.
struct RecallResult {
  static constexpr std::uint8_t kCurrent = 0;  ///< this one, the body that came over it, or none
  /// Of each cell, the look that says what it is: so many before this one.
  std::vector<std::uint8_t> from;
  int used = 0;      ///< earlier looks
  int rejected = 0;  ///< those that do not agree with the new one
  int changed = 0;   ///< cells of which nothing earlier is believed any more
};

/// What earlier looks knew, and where the body has been, in odom. The lasers sit at the ends of the
/// vehicle and see nothing beside it, nor what is right before it; earlier looks did, from farther
/// away. Each look is kept as it was, alone, so that nothing is handed on from map to map. Held in
/// bounds by the way since then and by number; a restart begins with nothing.
class TerrainMemory {
 public:
  explicit TerrainMemory(const TerrainParams& params);

  /// Where the body is. After a jump of odom nothing is remembered until it is tied to the one of
  /// before.
  void add(std::int64_t utime, const Pose2& T_odom_body);
  /// Odom has begun anew then: as after a jump, though there may be none.
  void reset(std::int64_t odom_epoch_utime);
  /// Where the odom of before the last jump lies in that of now: what was known in it counts again.
  void anchor(const Pose2& T_odom_previous);

  /// Fills in what the map does not know, newest first, and keeps what it knew itself. What it has
  /// really seen stays; what stood where it cannot look still stands there. The map has its heights
  /// alone: `clearance_m` is that of the roof.
  const RecallResult& recall(TerrainMap& map);

  [[nodiscard]] const RecallResult& recall_result() const { return recall_result_; }
  [[nodiscard]] std::size_t maps() const { return maps_.size(); }

 private:
  void gather_all(const TerrainMap& map);
  void gather(const TerrainMap& map, const RememberedMap& before, const HeightPlane& plane,
              std::uint8_t which);
  void merge(TerrainMap& map, RememberedMap& single_scan);

  TerrainParams params_;
  DrivenPath path_;
  std::deque<RememberedMap> maps_;      ///< newest first
  std::deque<RememberedMap> previous_;  ///< likewise, in the odom of before
  RecallResult recall_result_;
  std::vector<RememberedCell> recalled_;
  std::vector<std::uint8_t> from_;     ///< who said what is recalled
  std::vector<float> observed_at_m_;   ///< of the way, when that was
  std::vector<std::uint8_t> changed_;  ///< cells for which nothing is to be recalled
};

}  // namespace adit
