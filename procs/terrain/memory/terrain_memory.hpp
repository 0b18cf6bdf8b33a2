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

/// Result of filling a map from memory.
struct RecallResult {
  static constexpr std::uint16_t kCurrent = 0;  ///< current scan, driven ground or unknown
  /// The scan that each cell is from: so many before the current one.
  std::vector<std::uint16_t> from;
  int used = 0;      ///< earlier scans used
  int rejected = 0;  ///< earlier scans that cannot be aligned
  int changed = 0;   ///< cells for which earlier scans no longer count
};

/// Earlier scans and the traversed path, in odom. The lasers are at the ends of the vehicle and
/// cannot observe the ground beside and directly in front of it; earlier scans did, from farther
/// away. Each scan is stored by itself, so that no error is passed on from map to map. Scans taken
/// on the same level count (DrivenPath), as far back as odom is accurate enough or map has placed
/// them; bounded by number, and empty after a restart.
class TerrainMemory {
 public:
  explicit TerrainMemory(const TerrainParams& params);

  /// Adds a pose of the body. After a jump of odom nothing is recalled until `anchor` relates it to
  /// the previous odom frame.
  void add(std::int64_t utime, const Pose2& T_odom_body);
  /// A new odom frame has begun at this time: as after a jump, though there may be none.
  void reset(std::int64_t odom_epoch_utime);
  /// Sets the pose of the previous odom frame in the current one; scans in it count again.
  void anchor(const Pose2& T_odom_previous);
  /// Mapping has placed odom in map, see DrivenPath.
  void correct(const Pose2& T_after_before, double position_variance);

  /// Fills unknown cells of the map from earlier scans, newest first, and stores the scan. Cells
  /// observed in the scan are retained; obstacles in cells that it cannot observe are recalled. The
  /// map must contain heights only: its `clearance_m` is the height of the roof.
  const RecallResult& recall(TerrainMap& map);

  [[nodiscard]] const RecallResult& recall_result() const { return recall_result_; }
  [[nodiscard]] std::size_t maps() const { return maps_.size(); }

 private:
  void gather_all(const TerrainMap& map, const std::vector<DrivenPath::Place>& same_level);
  void gather(const TerrainMap& map, const RememberedMap& before, const HeightPlane& plane,
              std::uint16_t which);
  void merge(TerrainMap& map, RememberedMap& single_scan);

  TerrainParams params_;
  DrivenPath path_;
  std::deque<RememberedMap> maps_;      ///< newest first
  std::deque<RememberedMap> previous_;  ///< likewise, in the previous odom frame
  RecallResult recall_result_;
  std::vector<RememberedCell> recalled_;
  std::vector<std::uint16_t> from_;    ///< scan of each recalled cell
  std::vector<float> observed_at_m_;   ///< distance travelled at its observation
  std::vector<std::uint8_t> changed_;  ///< cells for which earlier scans do not count
};

}  // namespace adit
