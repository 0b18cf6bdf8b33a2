// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/resampling.hpp"

#include "common/volume/octree_stream.hpp"

namespace adit {
namespace {

class Resampler {
 public:
  Resampler(double cell_m, const Pose2& T_map_volume)
      : grid_(cell_m), T_map_volume_(T_map_volume) {}

  void add_middle(const VoxelGrid::Keys& keys, CellSet& set) const { add(keys, 0.0, 0.0, set); }

  /// Samples half a cell apart: whatever the turn, no cell of map lies between them.
  void add_quarters(const VoxelGrid::Keys& keys, CellSet& set) const {
    const double quarter = 0.25 * grid_.cell_m();
    for (const double dx : {-quarter, quarter}) {
      for (const double dy : {-quarter, quarter}) add(keys, dx, dy, set);
    }
  }

 private:
  void add(const VoxelGrid::Keys& keys, double dx, double dy, CellSet& set) const {
    const Eigen::Vector3d p_volume = grid_.centre_m(keys);
    const Eigen::Vector2d p_map =
        T_map_volume_ * Eigen::Vector2d(p_volume.x() + dx, p_volume.y() + dy);
    const auto at =
        grid_.keys_of({static_cast<float>(p_map.x()), static_cast<float>(p_map.y()), 0.0F});
    if (at) set.insert(VoxelGrid::code_of({at->x(), at->y(), keys.z()}));
  }

  VoxelGrid grid_;
  Pose2 T_map_volume_;
};

}  // namespace

void resample(const SubVolume& volume, const Pose2& T_map_volume, CellSet& free,
              CellSet& occupied) {
  const Resampler resampler(volume.cell_m(), T_map_volume);
  visit_leaves(volume.octree(), [&](const CellRun& leaf) {
    for (VoxelCode cell = leaf.first; cell < leaf.end; ++cell) {
      const VoxelGrid::Keys keys = VoxelGrid::keys_at(cell);
      if (leaf.occupied) {
        resampler.add_middle(keys, occupied);
      } else {
        resampler.add_quarters(keys, free);
      }
    }
  });
}

}  // namespace adit
