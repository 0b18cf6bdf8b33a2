// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/cloud.hpp"
#include "procs/volume_map/placed_volume.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {

struct VolumeMapParams : SubVolumeParams {
  double span_m = 10.0;  ///< from the first scan of a sub-volume to its last one
  /// A scan replaces all older ones from within this radius with the same heading; 0: none.
  double replace_radius_m = 0.0;

  template <class V>
  void visit(V& v) {
    SubVolumeParams::visit(v);
    v("span_m", span_m, within(0.0, 100.0));
    v("replace_radius_m", replace_radius_m, within(0.0, 10.0));
  }
};

/// All stored volumes.
struct StoredVolumes {
  std::vector<StoredVolume> volumes;
  std::vector<std::int64_t> scan_utimes;  ///< see VolumeMap::scan_utimes
  std::optional<AnchoredOdom> odom;       ///< see VolumeMap::newest_anchored_odom
};

/// Volumetric map of the mine as sub-volumes of OctoMap (Hornung et al. 2013), each anchored to the
/// local map that was the newest one when its scans arrived. A change of the pose graph moves the
/// sub-volumes; no scan is inserted again.
///
/// Scans before the first graph make sub-volumes that are anchored when it arrives. Only the newest
/// sub-volume accepts further scans; the others are closed (SubVolume::close), so that memory grows
/// with the number of scans. Where a mine is traversed repeatedly, the newest scan from a viewpoint
/// may replace the older ones (`replace_radius_m`, see placed_volume.hpp): it is the valid one,
/// and memory grows with the mine only. A sub-volume then holds the scans of one visit to one
/// place, and its id may have belonged to another place.
///
/// When mapping begins a session, with a new odom frame, an older scan is anchored by the odom
/// frame it was taken in, also across a restart. A scan whose odom frame is unknown is excluded.
class VolumeMap {
 public:
  explicit VolumeMap(const VolumeMapParams& params) : params_(params) {}

  /// Continues stored volumes; must precede any scan. Throws std::runtime_error if their cell size
  /// differs.
  void restore(StoredVolumes stored);

  /// Frees the points of all sub-volumes, once they are stored: only export needs them.
  void release_points();

  /// Inserts a scan into the newest sub-volume, if that is anchored to the same local map and near,
  /// otherwise into a new one. Returns false if the scan cannot be localized and is excluded.
  bool add(const Cloud& cloud);

  /// Times of all scans added, also before a restart, including excluded ones, in the order of
  /// arrival: a missed scan arrives late.
  [[nodiscard]] const std::vector<std::int64_t>& scan_utimes() const { return scan_utimes_; }
  [[nodiscard]] bool has(std::int64_t utime) const;

  /// Sets the begin of the odom frame of the first scan match since the start: older scans were
  /// taken in another frame.
  void set_odom_epoch(std::int64_t utime);
  /// Whether the first scan match has arrived.
  [[nodiscard]] bool has_odom_epoch() const { return has_odom_epoch_; }
  /// Scans that ended before this time cannot be localized; 0: all can.
  [[nodiscard]] std::int64_t localized_from_utime() const;
  /// The current odom frame, or the previous one until the current one is anchored.
  [[nodiscard]] const std::optional<AnchoredOdom>& newest_anchored_odom() const {
    return odom_ ? odom_ : previous_odom_;
  }

  /// Moves the anchored sub-volumes. A sub-volume whose local map is not in the graph keeps its
  /// pose.
  void set_graph(const MapGraph& graph);
  /// Anchors later scans, and those before the first anchor, as soon as graph and correction have
  /// the same revision.
  void set_correction(const MapCorrection& correction);

  [[nodiscard]] const std::vector<PlacedVolume>& volumes() const { return volumes_; }
  [[nodiscard]] std::int64_t graph_revision() const { return graph_.revision; }
  [[nodiscard]] std::int64_t rejected_points() const;
  /// Scans that were excluded because they cannot be localized.
  [[nodiscard]] int excluded() const { return excluded_; }

  /// All sub-volumes in one tree in map, for export. The cells of sub-volumes are not aligned with
  /// those of map, so that the tree is resampled: a cell is occupied if it contains the centre of
  /// an occupied cell of any sub-volume, otherwise free if it contains a part of a free one (up to
  /// a quarter of a cell from its sample points). Heights are rounded to whole cells. Each cell has
  /// the log-odds of one measurement.
  [[nodiscard]] OccupancyTree merged() const;

 private:
  [[nodiscard]] bool is_older_than_session(const Cloud& cloud) const;
  [[nodiscard]] bool can_localize(const Cloud& cloud) const;
  [[nodiscard]] bool newest_accepts(const Cloud& cloud,
                                    const std::optional<AnchoredOdom>& odom) const;
  void begin_volume(const Cloud& cloud, const std::optional<AnchoredOdom>& odom);
  [[nodiscard]] std::size_t replace_older(PlacedVolume& created);
  [[nodiscard]] std::size_t free_id() const;
  void discard(PlacedVolume& placed) const;
  void update_anchor();
  void end_odom(std::int64_t utime);
  void exclude_restored_volumes_of_other_odom();
  void anchor(PlacedVolume& placed, const AnchoredOdom& odom) const;

  VolumeMapParams params_;
  std::vector<PlacedVolume> volumes_;
  std::size_t newest_ = 0;  ///< index of the one with the last scan
  std::vector<std::int64_t> scan_utimes_;
  MapGraph graph_;
  std::optional<MapCorrection> correction_;
  std::optional<AnchoredOdom> odom_;  ///< from the newest correction with its graph, or restored
  std::optional<AnchoredOdom> previous_odom_;  ///< of the previous session
  std::int64_t session_begin_utime_ = 0;       ///< latest possible begin of the current session
  bool has_odom_epoch_ = false;
  std::size_t restored_ = 0;  ///< number of restored sub-volumes
  int excluded_ = 0;
};

}  // namespace adit
