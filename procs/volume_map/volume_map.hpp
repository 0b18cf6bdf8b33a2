// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/types/cloud.hpp"
#include "procs/volume_map/placed_volume.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {

struct VolumeMapParams : SubVolumeParams {
  double span_m = 10.0;  ///< from the first scan of a sub-volume to the last one
  /// A look takes the place of all older ones from this near that look the same way; 0: of none.
  double replace_radius_m = 0.0;

  template <class V>
  void visit(V& v) {
    SubVolumeParams::visit(v);
    v("span_m", span_m, within(0.0, 100.0));
    v("replace_radius_m", replace_radius_m, within(0.0, 10.0));
  }
};

/// All that is kept.
struct StoredVolumes {
  std::vector<StoredVolume> volumes;
  std::vector<std::int64_t> scan_utimes;  ///< see VolumeMap::scan_utimes
  std::optional<AnchoredOdom> odom;       ///< see VolumeMap::newest_anchored_odom
};

/// The mine as a volume: sub-volumes, each tied to the local map that was the newest one when its
/// scans came. A change of the graph moves them, and nothing is inserted again.
///
/// Scans that come before the first graph make sub-volumes of their own, which are tied when it
/// comes. The newest sub-volume alone is open to more scans; all others are as small as
/// SubVolume::close says, so that memory grows with the number of scans. Where a mine is gone
/// through again and again, the newest look from a place may take the place of the older ones
/// (`replace_radius_m`, see renewal.hpp): it is the one that is still true, and memory grows with
/// the mine alone. A sub-volume then has the looks of one visit to one place, and its id may be
/// that of another place before.
///
/// Where mapping begins a session, that is with a new odom frame, a scan from before is tied by the
/// odom frame that it was taken in, also where that was before a restart. One of which nobody knows
/// where that was is left out.
class VolumeMap {
 public:
  explicit VolumeMap(const VolumeMapParams& params) : params_(params) {}

  /// Goes on from what was kept, before anything is added. Throws std::runtime_error where its
  /// cells are of another size.
  void restore(StoredVolumes stored);

  /// Of all sub-volumes, once they are kept: nobody but who exports them needs the points.
  void release_points();

  /// Takes a scan into the newest sub-volume, if that is tied to the same local map and near, or
  /// else into a new one. False where it is left out.
  bool add(const Cloud& cloud);

  /// Times of the scans that were added, also before a restart and of those that were left out, in
  /// the order in which they came: one that was missed comes late.
  [[nodiscard]] const std::vector<std::int64_t>& scan_utimes() const { return scan_utimes_; }
  [[nodiscard]] bool has(std::int64_t utime) const;

  /// The odom frame of the first scan match since this began, began then: what is older was taken
  /// in another one.
  void set_odom_epoch(std::int64_t utime);
  /// False before the first scan match.
  [[nodiscard]] bool has_odom_epoch() const { return has_odom_epoch_; }
  /// Nobody knows where scans were taken that ended before; 0: of all it is known.
  [[nodiscard]] std::int64_t localized_from_utime() const;
  /// The present one, or the one before as long as that is not tied.
  [[nodiscard]] const std::optional<AnchoredOdom>& newest_anchored_odom() const {
    return odom_ ? odom_ : previous_odom_;
  }

  /// Moves what is tied. A sub-volume of a local map that the graph lacks stays where it is.
  void set_graph(const MapGraph& graph);
  /// Ties what comes from now on, and what came before the first, as soon as both are of one
  /// revision.
  void set_correction(const MapCorrection& correction);

  [[nodiscard]] const std::vector<PlacedVolume>& volumes() const { return volumes_; }
  [[nodiscard]] std::int64_t graph_revision() const { return graph_.revision; }
  [[nodiscard]] std::int64_t rejected_points() const;
  /// Scans that were left out, since nobody knows where they were taken.
  [[nodiscard]] int excluded() const { return excluded_; }

  /// All in one tree in map, for export. As the cells of sub-volumes do not lie on those of map, it
  /// is resampled: a cell is occupied if the middle of an occupied cell of any sub-volume is in it,
  /// and free if else a part of a free one is in it (at most a quarter of a cell from where its
  /// samples lie). It has the log-odds of one measurement.
  [[nodiscard]] OccupancyTree merged() const;

 private:
  [[nodiscard]] bool newest_accepts(const Cloud& cloud,
                                    const std::optional<AnchoredOdom>& odom) const;
  void begin_volume(const Cloud& cloud, const std::optional<AnchoredOdom>& odom);
  [[nodiscard]] std::size_t replace_older(PlacedVolume& created);
  [[nodiscard]] std::size_t free_id() const;
  void discard(PlacedVolume& placed) const;
  void update_anchor();
  void end_odom(std::int64_t utime);
  void exclude_volumes_of_other_odom();
  void anchor(PlacedVolume& placed, const AnchoredOdom& odom) const;

  VolumeMapParams params_;
  std::vector<PlacedVolume> volumes_;
  std::size_t newest_ = 0;  ///< index of the one that scans came into last
  std::vector<std::int64_t> scan_utimes_;
  MapGraph graph_;
  std::optional<MapCorrection> correction_;
  std::optional<AnchoredOdom> odom_;  ///< as of the newest correction that has its graph, or kept
  std::optional<AnchoredOdom> previous_odom_;  ///< of the session before, as long as that was known
  std::int64_t session_begin_utime_ = 0;       ///< by which the present session had begun
  bool has_odom_epoch_ = false;
  std::size_t restored_ = 0;  ///< sub-volumes that were kept
  int excluded_ = 0;
};

}  // namespace adit
