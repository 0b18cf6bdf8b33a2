// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "procs/exploration/map/layers.hpp"
#include "procs/exploration/map/local_map_tile.hpp"
#include "procs/exploration/map/scanned_ground.hpp"

namespace adit {

enum class Occupancy : std::uint8_t {
  kUnseen,
  kFree,
  kWall,
  kDriven,  ///< free, whatever the scans say: the body has been there
};

struct KnownSpaceParams {
  LocalMapTileParams tiles;
  double update_distance_m = 0.05;  ///< motion of any point after which a tile votes again
  double unseen_patch_m2 = 1.0;     ///< enclosed unseen patches up to this size count as free
  int cells_max = 20'000'000;       ///< limit of the grid; a cell takes 14 bytes

  template <class V>
  void visit(V& v) {
    v("tiles", tiles);
    v("update_distance_m", update_distance_m, above(0.0));
    v("unseen_patch_m2", unseen_patch_m2, at_least(0.0));
    v("cells_max", cells_max, at_least(1));
  }
};

/// A tile of the known space, by the id of its local map, and its pose in atlas.
struct PosedTile {
  int id = 0;
  Pose2 T_map_local;
};

/// Walls that count.
enum class Walls : std::uint8_t {
  kAll,        ///< all returns of the level lasers, except from ground that 3D scans observed
  kConfirmed,  ///< of these the steep ones and those where a 3D scan observed rock; the others are
               ///< unseen, as they may be rising ground or falling roof
};

/// Occupancy of the mine, from the tiles of all local maps and the ground of all 3D scans, each at
/// its pose in the graph. A tile casts votes for free and for wall, and withdraws them when it
/// moves, so that a graph update costs only what has moved. Where levels lie above each other each
/// layer has its own cells (separate_layers). All positions and poses that this class and its users
/// return and take as `map` are in atlas, unless they say otherwise: map, with the layers side by
/// side. With a single layer both frames are the same.
class KnownSpace {
 public:
  explicit KnownSpace(const KnownSpaceParams& params) : params_(params) {}

  /// Adds a tile, or replaces the one with the same id.
  void add(int id, LocalMapTile tile);
  void add(ScannedGround ground);
  /// Forgets what 3D scans observed.
  void clear_scanned_ground();
  [[nodiscard]] const std::vector<ScannedGround>& scanned_ground() const { return ground_; }

  /// Sets the poses of all tiles in map, by id. Tiles that are not in the graph are withdrawn.
  /// `z_m`, `z_variance`: as MapGraph; without heights there is a single layer.
  void pose(const std::vector<Pose2>& T_map_local, const std::vector<double>& z_m = {},
            const std::vector<double>& z_variance = {});

  [[nodiscard]] const Atlas& atlas() const { return atlas_; }
  /// The layer of a body at a place in map, at this height in map if that is known: that of the
  /// tile at about the same height whose path is nearest to it.
  [[nodiscard]] int layer_at(const Eigen::Vector2d& p_map, std::optional<double> z_m) const;
  /// Height of the ground in map, by the nearest tile of the layer [m]; empty if heights are
  /// unknown.
  [[nodiscard]] std::optional<double> height_near(const Eigen::Vector2d& p_atlas) const;
  /// The same place in the layer of the tile that observed it, where it has several.
  [[nodiscard]] Eigen::Vector2d in_own_layer(const Eigen::Vector2d& p_atlas) const;
  /// Where open air was observed, by the id of the local map.
  [[nodiscard]] std::vector<std::pair<int, OpenAir>> open_air() const;
  /// Cells that are the same place in several layers, of the box of `cells`.
  [[nodiscard]] SharedCells shared_cells() const;

  /// All cells, with a rim of two unseen cells. Without 3D scans all walls count.
  [[nodiscard]] Grid2<Occupancy> cells(Walls walls = Walls::kAll) const;

  /// 1 in each of these cells in which 3D scans show an obstacle that the vehicle cannot drive
  /// over, more of them than even ground.
  [[nodiscard]] Grid2<std::uint8_t> low_obstacles() const;

  /// Whether returns of the level lasers within three cells of a point count as no wall, by what 3D
  /// scans observed.
  [[nodiscard]] bool dismisses_wall_near(const Eigen::Vector2d& p_map, Walls walls) const;

  /// Whether 3D scans show that the space ahead of a point ends at rock, over the width of a
  /// vehicle: ground up to the foot of the rock, so that it is no roof behind a crest.
  [[nodiscard]] bool shows_rock_ahead(const Eigen::Vector2d& p_map,
                                      const Eigen::Vector2d& direction_map) const;

  /// The tile that observed this point as free and whose path is nearest to it: the one to anchor
  /// it to; one that has this layer as its own, if there is any. Empty if there is none within 20
  /// m.
  [[nodiscard]] std::optional<PosedTile> tile_at(const Eigen::Vector2d& p_map) const;

  /// Distance of a point from where the body has been, in its layer [m]; infinite if nowhere.
  [[nodiscard]] double driven_distance_m(const Eigen::Vector2d& p_map) const;
  /// Id of the newest tile that observed this point as free; empty if there is none.
  [[nodiscard]] std::optional<int> newest_at(const Eigen::Vector2d& p_map) const;

  [[nodiscard]] double resolution_m() const { return params_.tiles.resolution_m; }
  /// Pose of the tile in its own layer; empty if it has none.
  [[nodiscard]] std::optional<Pose2> pose_of(int id) const;
  /// Its poses in all its layers, its own first.
  [[nodiscard]] std::vector<Pose2> poses_of(int id) const;
  /// The tile with the largest id among those that have a pose; empty before the first.
  [[nodiscard]] std::optional<PosedTile> newest() const;
  /// Tiles dropped because the grid would become too large or their pose is invalid.
  [[nodiscard]] int dropped_tiles() const { return dropped_tiles_; }

 private:
  struct Votes {
    std::uint16_t free = 0;
    std::uint16_t wall = 0;
    std::uint16_t steep_wall = 0;
    std::uint16_t ground = 0;
    std::uint16_t rock = 0;
    std::uint16_t obstacle = 0;
  };
  struct Entry {
    LocalMapTile tile;
    std::optional<Pose2> T_map_local;  ///< pose in map at which it has voted,
    std::vector<int> layers;           ///< and the layers, its own first
    std::optional<double> z_m;         ///< height in map
    double radius_m = 0.0;

    [[nodiscard]] bool is_in(int layer) const {
      return std::find(layers.begin(), layers.end(), layer) != layers.end();
    }
  };

  class PlacedVotes;

  [[nodiscard]] bool moved(const std::optional<Pose2>& T_map_voted, const Pose2& T_map,
                           double radius_m) const;
  [[nodiscard]] std::vector<std::vector<int>> layers_of(
      const std::vector<Pose2>& T_map_local, const std::vector<double>& z_m,
      const std::vector<double>& z_variance) const;
  void lay_out();
  [[nodiscard]] CellBox box() const;
  [[nodiscard]] bool reserve(int layer, const Pose2& T_map, double radius_m);
  [[nodiscard]] bool reserve(const std::vector<int>& layers, const Pose2& T_map, double radius_m);
  void enter(Entry& entry, const Pose2& T_map_local, std::vector<int> layers);
  [[nodiscard]] Pose2 in_atlas(const Entry& entry, int layer) const;
  void withdraw(Entry& entry);
  void vote(const Entry& entry, int sign);
  [[nodiscard]] bool enter_ground(std::size_t i);
  void withdraw_ground(std::size_t i);
  void vote_ground(std::size_t i, int sign);
  /// `visit(votes, i, cell)`: cell i of the votes of each layer, and its place in atlas.
  template <class Visit>
  void for_each_cell(const Visit& visit) const;
  [[nodiscard]] static bool has_returns(const Votes& votes);
  [[nodiscard]] static bool is_confirmed_wall(const Grid2<Votes>& votes, std::size_t i);
  [[nodiscard]] Occupancy occupancy(const Grid2<Votes>& layer, std::size_t i, Walls walls) const;
  [[nodiscard]] bool shows_rock_along(const Grid2<Votes>& votes, const Eigen::Vector2d& p_map,
                                      const Eigen::Vector2d& direction) const;
  void mark_driven(Grid2<Occupancy>& known, int layer) const;
  void fill_patches(Grid2<Occupancy>& known) const;

  KnownSpaceParams params_;
  std::map<int, Entry> entries_;
  std::vector<ScannedGround> ground_;
  /// A vote of what a 3D scan observed.
  struct GroundVote {
    Pose2 T_map_level;
    std::vector<int> layers;
  };
  std::vector<std::optional<GroundVote>> ground_votes_;  ///< of `ground_`
  std::vector<Grid2<Votes>> layers_{Grid2<Votes>()};     ///< in map
  Atlas atlas_;
  int dropped_tiles_ = 0;
};

}  // namespace adit
