// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "procs/exploration/map/local_map_tile.hpp"

namespace adit {

enum class Occupancy : std::uint8_t {
  kUnseen,
  kFree,
  kWall,
  kDriven,  ///< free, whatever else was seen: the body has been there
};

struct KnownSpaceParams {
  LocalMapTileParams tiles;
  double update_distance_m = 0.05;  ///< a tile is entered anew when it moved this far anywhere
  double unseen_patch_m2 = 1.0;     ///< what is not seen and no larger than this is free
  int cells_max = 20'000'000;       ///< beyond these nothing is entered; a cell takes 6 bytes

  template <class V>
  void visit(V& v) {
    v("tiles", tiles);
    v("update_distance_m", update_distance_m, above(0.0));
    v("unseen_patch_m2", unseen_patch_m2, at_least(0.0));
    v("cells_max", cells_max, at_least(1));
  }
};

/// What is known of the mine, in map: the tiles of all local maps, each where the graph has it. A
/// tile votes for free and for wall, and takes its votes back when it moves; so that only what
/// moved costs anything.
class KnownSpace {
 public:
  explicit KnownSpace(const KnownSpaceParams& params) : params_(params) {}

  /// A tile, in place of an older one of the same id.
  void add(int id, LocalMapTile tile);

  /// Where all tiles are, by id. Tiles that the graph does not know are left out.
  void pose(const std::vector<Pose2>& T_map_local);

  /// Everything, with a rim of two cells that were not seen.
  [[nodiscard]] Grid2<Occupancy> cells() const;

  /// The nearest tile, by its way, that saw this place free: the one to tie it to.
  [[nodiscard]] std::optional<int> tile_at(const Eigen::Vector2d& p_map) const;

  /// The newest tile that saw this place free; nothing where none did.
  [[nodiscard]] std::optional<int> newest_at(const Eigen::Vector2d& p_map) const;

  [[nodiscard]] double resolution_m() const { return params_.tiles.resolution_m; }
  /// Where the tile is in the map; nothing where it is nowhere.
  [[nodiscard]] std::optional<Pose2> pose_of(int id) const;
  /// The largest id in place; nothing before the first.
  [[nodiscard]] std::optional<int> newest() const;
  /// Tiles left out for want of room.
  [[nodiscard]] int dropped_tiles() const { return dropped_tiles_; }

 private:
  struct Votes {
    std::uint16_t free = 0;
    std::uint16_t wall = 0;
  };
  struct Entry {
    LocalMapTile tile;
    std::optional<Pose2> T_map_local;  ///< where its votes are
    double radius_m = 0.0;
  };

  [[nodiscard]] bool moved(const Entry& entry, const Pose2& T_map_local) const;
  [[nodiscard]] bool reserve(const CellBox& box);
  void enter(Entry& entry, const Pose2& T_map_local);
  void withdraw(Entry& entry);
  void vote(const Entry& entry, int sign);
  void mark_driven(Grid2<Occupancy>& known) const;
  void fill_patches(Grid2<Occupancy>& known) const;

  KnownSpaceParams params_;
  std::map<int, Entry> entries_;
  Grid2<Votes> votes_;
  int dropped_tiles_ = 0;
};

}  // namespace adit
