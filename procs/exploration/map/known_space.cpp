// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/known_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace adit {
namespace {

// A cell of a tile or of a 3D scan votes at four points within it, so that rotated cells leave no
// holes; a return counts as much as the four together.
constexpr int kVotesOfCell = 4;
// A wall with this many times more votes for free is free: grazing beams pass through walls.
constexpr int kFreeOverWall = 3;
constexpr double kDrivenRadiusM = 0.3;
constexpr int kRim = 2;
constexpr int kSlack = 50;  // cells by which the grid grows at least
constexpr double kAnchorRadiusM = 20.0;
constexpr double kFarM = 1e6;        // positions beyond it are errors
constexpr double kSameLevelM = 2.5;  // heights of a body in one tunnel differ by less
constexpr double kSeamM =
    2.0;  // gap between consecutive local maps, beyond which the path of the body is not continuous

double radius_of(const LocalMapTile& tile, double resolution_m) {
  double radius = 0.0;
  for (const auto& cell : tile.free)
    radius = std::max(radius, centre_of(cell, resolution_m).norm());
  for (const auto& wall : tile.walls) radius = std::max(radius, wall.p_local.norm());
  for (const auto& p : tile.path) radius = std::max(radius, p.norm());
  return radius + resolution_m;
}

void mark_disc(Grid2<Occupancy>& known, const Eigen::Vector2d& p, double resolution_m) {
  const int reach = static_cast<int>(kDrivenRadiusM / resolution_m);
  const Eigen::Vector2i middle = cell_of(p, resolution_m);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
      if (known.box().contains(cell)) known[known.index(cell)] = Occupancy::kDriven;
    }
  }
}

void mark_line(Grid2<Occupancy>& known, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
               double resolution_m) {
  const int steps = 1 + static_cast<int>((to - from).norm() / (0.5 * resolution_m));
  for (int i = 0; i <= steps; ++i) {
    mark_disc(known, from + (to - from) * (static_cast<double>(i) / steps), resolution_m);
  }
}

/// Distance of a point from where the body has been in a local map [m].
double path_distance_m(const LocalMapTile& tile, const Eigen::Vector2d& p_local) {
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& p : tile.path) distance = std::min(distance, (p - p_local).norm());
  return distance;
}

}  // namespace

void KnownSpace::add(int id, LocalMapTile tile) {
  Entry& entry = entries_[id];
  withdraw(entry);
  entry.radius_m = radius_of(tile, resolution_m());
  entry.tile = std::move(tile);
}

void KnownSpace::add(ScannedGround ground) {
  ground_.push_back(std::move(ground));
  ground_votes_.emplace_back();
  dropped_tiles_ += enter_ground(ground_.size() - 1) ? 0 : 1;
  lay_out();
}

void KnownSpace::clear_scanned_ground() {
  for (std::size_t i = 0; i < ground_.size(); ++i) withdraw_ground(i);
  ground_.clear();
  ground_votes_.clear();
}

void KnownSpace::pose(const std::vector<Pose2>& T_map_local, const std::vector<double>& z_m,
                      const std::vector<double>& z_variance) {
  dropped_tiles_ = 0;
  const std::vector<std::vector<int>> layers = layers_of(T_map_local, z_m, z_variance);
  int count = 1;
  for (const auto& of_map : layers) count = std::max(count, 1 + std::ranges::max(of_map));
  layers_.resize(std::max(layers_.size(), static_cast<std::size_t>(count)));
  for (auto& [id, entry] : entries_) {
    const bool posed = id >= 0 && static_cast<std::size_t>(id) < T_map_local.size();
    if (!posed) {
      withdraw(entry);
      continue;
    }
    const auto i = static_cast<std::size_t>(id);
    entry.z_m = i < z_m.size() ? std::optional(z_m[i]) : std::nullopt;
    const bool stays = !moved(entry.T_map_local, T_map_local[i], entry.radius_m);
    if (stays && entry.layers == layers[i]) continue;
    withdraw(entry);
    enter(entry, T_map_local[i], layers[i]);
  }
  for (std::size_t i = 0; i < ground_.size(); ++i) dropped_tiles_ += enter_ground(i) ? 0 : 1;
  layers_.resize(static_cast<std::size_t>(count));
  lay_out();
}

std::vector<std::vector<int>> KnownSpace::layers_of(const std::vector<Pose2>& T_map_local,
                                                    const std::vector<double>& z_m,
                                                    const std::vector<double>& z_variance) const {
  std::vector<MapFootprint> footprints(T_map_local.size());
  const bool has_heights = z_m.size() == T_map_local.size() && z_variance.size() == z_m.size();
  for (const auto& [id, entry] : entries_) {
    const auto i = static_cast<std::size_t>(id);
    if (!has_heights || id < 0 || i >= z_m.size()) continue;
    if (!std::isfinite(z_m[i]) || !std::isfinite(z_variance[i])) continue;
    footprints[i].z_variance = z_variance[i];
    for (const Eigen::Vector3d& p : entry.tile.footprint) {
      const Eigen::Vector2d p_map = T_map_local[i] * Eigen::Vector2d(p.head<2>());
      if (p_map.allFinite() && p_map.norm() < kFarM)
        footprints[i].points.emplace_back(p_map.x(), p_map.y(), z_m[i] + p.z());
    }
  }
  return separate_layers(footprints);
}

void KnownSpace::lay_out() {
  std::vector<CellBox> boxes;
  for (const Grid2<Votes>& layer : layers_) boxes.push_back(layer.box());
  atlas_ = Atlas(boxes, resolution_m());
}

/// Of all layers in atlas, with a rim of unseen cells; empty without cells.
CellBox KnownSpace::box() const {
  CellBox all;
  for (int layer = 0; layer < atlas_.layers(); ++layer) {
    const CellBox& box = layers_[static_cast<std::size_t>(layer)].box();
    if (box.empty()) continue;
    const Eigen::Vector2i shift(0, atlas_.shift(layer));
    const Eigen::Vector2i rim(kRim, kRim);
    const CellBox placed{box.from + shift - rim, box.to + shift + rim};
    all =
        all.empty() ? placed : CellBox{all.from.cwiseMin(placed.from), all.to.cwiseMax(placed.to)};
  }
  return all;
}

/// Whether what voted at a pose must vote again.
bool KnownSpace::moved(const std::optional<Pose2>& T_map_voted, const Pose2& T_map,
                       double radius_m) const {
  if (!T_map_voted) return true;
  const Pose2 motion = between(*T_map_voted, T_map);
  return motion.translation().norm() + radius_m * std::abs(motion.theta) >
         params_.update_distance_m;
}

void KnownSpace::enter(Entry& entry, const Pose2& T_map_local, std::vector<int> layers) {
  if (!reserve(layers, T_map_local, entry.radius_m)) {
    ++dropped_tiles_;
    return;
  }
  entry.T_map_local = T_map_local;
  entry.layers = std::move(layers);
  vote(entry, 1);
}

void KnownSpace::withdraw(Entry& entry) {
  if (!entry.T_map_local) return;
  vote(entry, -1);
  entry.T_map_local.reset();
}

bool KnownSpace::reserve(const std::vector<int>& layers, const Pose2& T_map, double radius_m) {
  return std::ranges::all_of(layers, [&](int layer) { return reserve(layer, T_map, radius_m); });
}

/// Makes room around a pose. Returns false if the pose is invalid or the grid would become too
/// large.
bool KnownSpace::reserve(int layer, const Pose2& T_map, double radius_m) {
  Grid2<Votes>& votes = layers_[static_cast<std::size_t>(layer)];
  const Eigen::Vector2d p = T_map.translation();
  if (!T_map.vector().allFinite() || p.norm() >= kFarM) return false;
  const Eigen::Vector2d reach(radius_m, radius_m);
  const CellBox box{cell_of(p - reach, resolution_m()),
                    cell_of(p + reach, resolution_m()) + Eigen::Vector2i(1, 1)};
  if (votes.size() > 0 && votes.box().contains(box)) return true;
  const Eigen::Vector2i slack(kSlack, kSlack);
  CellBox grown_box{box.from - slack, box.to + slack};
  if (votes.size() > 0) {
    grown_box.from = grown_box.from.cwiseMin(votes.box().from);
    grown_box.to = grown_box.to.cwiseMax(votes.box().to);
  }
  double cells = grown_box.size().cast<double>().prod() - static_cast<double>(votes.size());
  for (const Grid2<Votes>& each : layers_) cells += static_cast<double>(each.size());
  if (cells > params_.cells_max) return false;
  votes = votes.size() > 0 ? votes.grown_to(grown_box) : Grid2<Votes>(grown_box);
  return true;
}

/// The cells of the map, by points in the frame of what votes.
class KnownSpace::PlacedVotes {
 public:
  PlacedVotes(Grid2<Votes>& votes, const Pose2& T_map_voter, double resolution_m)
      : votes_(votes),
        T_(T_map_voter),
        c_(std::cos(T_map_voter.theta)),
        s_(std::sin(T_map_voter.theta)),
        side_(resolution_m) {}

  [[nodiscard]] Votes& at(double x, double y) {
    return votes_[votes_.index(cell_of({T_.x + c_ * x - s_ * y, T_.y + s_ * x + c_ * y}, side_))];
  }
  /// Adds `sign` to a count at each of the four points within a cell of the voter.
  void add(const Eigen::Vector2i& cell, std::uint16_t Votes::*count, int sign) {
    for (const double dy : {0.25, 0.75}) {
      for (const double dx : {0.25, 0.75}) {
        std::uint16_t& votes = at(side_ * (cell.x() + dx), side_ * (cell.y() + dy)).*count;
        votes = static_cast<std::uint16_t>(votes + sign);
      }
    }
  }

 private:
  Grid2<Votes>& votes_;
  const Pose2& T_;
  double c_;
  double s_;
  double side_;
};

void KnownSpace::vote(const Entry& entry, int sign) {
  for (const int layer : entry.layers) {
    PlacedVotes placed(layers_[static_cast<std::size_t>(layer)], *entry.T_map_local,
                       resolution_m());
    for (const Eigen::Vector2i& cell : entry.tile.free) placed.add(cell, &Votes::free, sign);
    for (const WallCell& wall : entry.tile.walls) {
      Votes& votes = placed.at(wall.p_local.x(), wall.p_local.y());
      votes.wall = static_cast<std::uint16_t>(votes.wall + sign * kVotesOfCell);
      if (wall.steep) votes.steep_wall = static_cast<std::uint16_t>(votes.steep_wall + sign);
    }
  }
}

/// Votes at the present pose of its local map, if it has one. Returns false if the grid would
/// become too large.
bool KnownSpace::enter_ground(std::size_t i) {
  const ScannedGround& ground = ground_[i];
  const auto entry = entries_.find(ground.local_map);
  const bool posed = entry != entries_.end() && entry->second.T_map_local;
  const auto T_map_level =
      posed ? std::optional(*entry->second.T_map_local * ground.T_local_level) : std::nullopt;
  const CellBox& box = ground.cells.box();
  const double radius_m =
      resolution_m() * (box.from.cwiseAbs().cwiseMax(box.to.cwiseAbs())).cast<double>().norm();
  std::optional<GroundVote>& vote = ground_votes_[i];
  if (T_map_level && vote && vote->layers == entry->second.layers &&
      !moved(vote->T_map_level, *T_map_level, radius_m)) {
    return true;
  }
  withdraw_ground(i);
  if (!T_map_level) return true;
  if (!reserve(entry->second.layers, *T_map_level, radius_m)) return false;
  vote = {*T_map_level, entry->second.layers};
  vote_ground(i, 1);
  return true;
}

void KnownSpace::withdraw_ground(std::size_t i) {
  if (!ground_votes_[i]) return;
  vote_ground(i, -1);
  ground_votes_[i].reset();
}

void KnownSpace::vote_ground(std::size_t i, int sign) {
  const Grid2<ScannedCell>& cells = ground_[i].cells;
  for (const int layer : ground_votes_[i]->layers) {
    PlacedVotes placed(layers_[static_cast<std::size_t>(layer)], ground_votes_[i]->T_map_level,
                       resolution_m());
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (cells[k] == ScannedCell::kUnknown) continue;
      const auto count = cells[k] == ScannedCell::kGround ? &Votes::ground
                         : cells[k] == ScannedCell::kRock ? &Votes::rock
                                                          : &Votes::obstacle;
      placed.add(cells.cell(k), count, sign);
    }
  }
}

/// Whether the wall in a cell is too steep for ground, or 3D scans observed rock within two cells.
bool KnownSpace::is_confirmed_wall(const Grid2<Votes>& votes, std::size_t i) {
  if (votes[i].steep_wall > 0) return true;
  constexpr int kReach = 2;
  const Eigen::Vector2i middle = votes.cell(i);
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      if (votes.get(middle + Eigen::Vector2i(x, y)).rock > 0) return true;
    }
  }
  return false;
}

bool KnownSpace::has_returns(const Votes& votes) {
  return votes.wall > 0 && kFreeOverWall * votes.wall >= votes.free;
}

Occupancy KnownSpace::occupancy(const Grid2<Votes>& layer, std::size_t i, Walls walls) const {
  const Votes& votes = layer[i];
  if (votes.free == 0 && votes.wall == 0) return Occupancy::kUnseen;
  const bool on_ground = votes.ground > 0 && votes.rock == 0;
  if (!has_returns(votes) || on_ground) return Occupancy::kFree;
  const bool counts = walls == Walls::kAll || ground_.empty() || is_confirmed_wall(layer, i);
  return counts ? Occupancy::kWall : Occupancy::kUnseen;
}

bool KnownSpace::dismisses_wall_near(const Eigen::Vector2d& p_map, Walls walls) const {
  constexpr int kReach = 3;
  const auto& layer = layers_[static_cast<std::size_t>(atlas_.layer_of(p_map))];
  const Eigen::Vector2i middle = cell_of(atlas_.to_map(p_map), resolution_m());
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
      if (!layer.contains(cell)) continue;
      const std::size_t i = layer.index(cell);
      if (has_returns(layer[i]) && occupancy(layer, i, walls) != Occupancy::kWall) return true;
    }
  }
  return false;
}

/// Along a ray: rock, and no more than kFootM before it without observed ground.
bool KnownSpace::shows_rock_along(const Grid2<Votes>& votes, const Eigen::Vector2d& p_map,
                                  const Eigen::Vector2d& direction) const {
  constexpr double kAheadM = 8.0;
  constexpr double kFootM = 1.0;  // ground beside an obstacle is not counted as such
  const double step_m = 0.5 * resolution_m();
  double ground_m = -kFootM;
  for (double s_m = 0.0; s_m <= kAheadM; s_m += step_m) {
    const Votes cell = votes.get(cell_of(p_map + s_m * direction, resolution_m()));
    if (cell.rock > 0) return s_m - ground_m <= kFootM;
    if (cell.ground > 0) ground_m = s_m;
  }
  return false;
}

bool KnownSpace::shows_rock_ahead(const Eigen::Vector2d& p_map,
                                  const Eigen::Vector2d& direction_map) const {
  constexpr double kBesideM = 0.5;
  const auto& layer = layers_[static_cast<std::size_t>(atlas_.layer_of(p_map))];
  const Eigen::Vector2d p = atlas_.to_map(p_map);
  const Eigen::Vector2d ahead = direction_map.normalized();
  const Eigen::Vector2d beside(-ahead.y(), ahead.x());
  for (const double y_m : {-kBesideM, 0.0, kBesideM}) {
    if (!shows_rock_along(layer, p + y_m * beside, ahead)) return false;
  }
  return true;
}

template <class Visit>
void KnownSpace::for_each_cell(const Visit& visit) const {
  for (int layer = 0; layer < atlas_.layers(); ++layer) {
    const Grid2<Votes>& votes = layers_[static_cast<std::size_t>(layer)];
    const Eigen::Vector2i shift(0, atlas_.shift(layer));
    for (std::size_t i = 0; i < votes.size(); ++i)
      visit(votes, i, Eigen::Vector2i(votes.cell(i) + shift));
  }
}

Grid2<Occupancy> KnownSpace::cells(Walls walls) const {
  const CellBox all = box();
  if (all.empty()) return {};
  Grid2<Occupancy> known(all, Occupancy::kUnseen);
  for_each_cell([&](const Grid2<Votes>& votes, std::size_t i, const Eigen::Vector2i& cell) {
    known[known.index(cell)] = occupancy(votes, i, walls);
  });
  fill_patches(known);
  for (int layer = 0; layer < atlas_.layers(); ++layer) mark_driven(known, layer);
  return known;
}

Grid2<std::uint8_t> KnownSpace::low_obstacles() const {
  const CellBox all = box();
  if (all.empty()) return {};
  Grid2<std::uint8_t> obstacles(all);
  for_each_cell([&](const Grid2<Votes>& votes, std::size_t i, const Eigen::Vector2i& cell) {
    if (votes[i].obstacle > votes[i].ground) obstacles[obstacles.index(cell)] = 1;
  });
  return obstacles;
}

SharedCells KnownSpace::shared_cells() const {
  if (atlas_.layers() == 1) return {};
  SharedCells shared(atlas_, box());
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local || entry.layers.size() < 2) continue;
    const auto add = [&, &entry = entry](const Eigen::Vector2d& p_local) {
      shared.add(cell_of(*entry.T_map_local * p_local, resolution_m()), entry.layers);
    };
    for (const Eigen::Vector2i& cell : entry.tile.free) {
      for (const auto& [dx, dy] :
           {std::pair(0.25, 0.25), {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
        add(resolution_m() * (cell.cast<double>() + Eigen::Vector2d(dx, dy)));
      }
    }
    // A return is no wall where a 3D scan shows ground, or where most beams pass.
    for (const WallCell& wall : entry.tile.walls) add(wall.p_local);
  }
  return shared;
}

/// Marks the path of the body as driven, across the seams of local maps too, where scans may leave
/// gaps. Within a known area mapping adds no local maps, so that the next one begins elsewhere:
/// such a jump is not a path.
void KnownSpace::mark_driven(Grid2<Occupancy>& known, int layer) const {
  constexpr int kNoSession = -1;
  Eigen::Vector2d last(0.0, 0.0);
  int session = kNoSession;
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local) continue;
    if (!entry.is_in(layer)) {
      session = kNoSession;
      continue;
    }
    for (const Eigen::Vector2d& p_local : entry.tile.path) {
      const Eigen::Vector2d p = atlas_.to_atlas(*entry.T_map_local * p_local, layer);
      const bool continues = session == entry.tile.session && (p - last).norm() <= kSeamM;
      mark_line(known, continues ? last : p, p, resolution_m());
      session = entry.tile.session;
      last = p;
    }
  }
}

/// Fills small unseen patches between beams that are enclosed by known cells.
void KnownSpace::fill_patches(Grid2<Occupancy>& known) const {
  const auto patch_cells_max =
      static_cast<std::size_t>(params_.unseen_patch_m2 / (resolution_m() * resolution_m()));
  const auto around = known.around();
  Grid2<std::uint8_t> visited(known.box());
  std::vector<std::size_t> patch;
  const auto columns = static_cast<std::size_t>(known.box().size().x());
  for (std::size_t i = columns + 1; i + columns + 1 < known.size(); ++i) {
    if (known[i] != Occupancy::kUnseen || visited[i] != 0 || known[i - 1] != Occupancy::kFree)
      continue;
    patch.assign(1, i);
    visited[i] = 1;
    bool enclosed = true;
    for (std::size_t k = 0; k < patch.size() && enclosed; ++k) {
      for (std::size_t side = 0; side < 8; side += 2) {
        const std::size_t next = patch[k] + static_cast<std::size_t>(around[side]);
        if (known[next] != Occupancy::kUnseen) continue;
        if (visited[next] == 1 && std::find(patch.begin(), patch.end(), next) != patch.end()) {
          continue;
        }
        if (visited[next] != 0 || patch.size() >= patch_cells_max) {
          enclosed = false;
          break;
        }
        visited[next] = 1;
        patch.push_back(next);
      }
    }
    if (!enclosed) continue;
    for (const std::size_t cell : patch) known[cell] = Occupancy::kFree;
  }
}

/// Pose of an entry that has one.
Pose2 KnownSpace::in_atlas(const Entry& entry, int layer) const {
  const Eigen::Vector2d p = atlas_.to_atlas(entry.T_map_local->translation(), layer);
  return {p.x(), p.y(), entry.T_map_local->theta};
}

std::optional<PosedTile> KnownSpace::tile_at(const Eigen::Vector2d& p_map) const {
  std::optional<PosedTile> best;
  bool best_is_own = false;
  double nearest = kAnchorRadiusM;
  const int layer = atlas_.layer_of(p_map);
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local || !entry.is_in(layer)) continue;
    const bool is_own = entry.layers.front() == layer;
    if (best_is_own && !is_own) continue;
    const Pose2 T_map_local = in_atlas(entry, layer);
    const Eigen::Vector2d p_local = T_map_local.inverse() * p_map;
    const double distance = path_distance_m(entry.tile, p_local);
    const double limit = is_own && !best_is_own ? kAnchorRadiusM : nearest;
    if (distance >= limit || !entry.tile.is_free(cell_of(p_local, resolution_m()))) continue;
    nearest = distance;
    best = {id, T_map_local};
    best_is_own = is_own;
  }
  return best;
}

double KnownSpace::driven_distance_m(const Eigen::Vector2d& p_map) const {
  double nearest = std::numeric_limits<double>::infinity();
  const int layer = atlas_.layer_of(p_map);
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local || !entry.is_in(layer)) continue;
    const Eigen::Vector2d p_local = in_atlas(entry, layer).inverse() * p_map;
    nearest = std::min(nearest, path_distance_m(entry.tile, p_local));
  }
  return nearest;
}

std::optional<int> KnownSpace::newest_at(const Eigen::Vector2d& p_map) const {
  const int layer = atlas_.layer_of(p_map);
  for (auto each = entries_.rbegin(); each != entries_.rend(); ++each) {
    const Entry& entry = each->second;
    if (!entry.T_map_local || !entry.is_in(layer)) continue;
    const Eigen::Vector2d p_local = in_atlas(entry, layer).inverse() * p_map;
    if (entry.tile.is_free(cell_of(p_local, resolution_m()))) return each->first;
  }
  return std::nullopt;
}

int KnownSpace::layer_at(const Eigen::Vector2d& p_map, std::optional<double> z_m) const {
  if (atlas_.layers() == 1) return 0;
  int layer = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local) continue;
    if (!z_m) {
      layer = entry.layers.front();  // of the newest
      continue;
    }
    const Eigen::Vector2d p_local = entry.T_map_local->inverse() * p_map;
    for (std::size_t i = 0; i < entry.tile.path.size(); ++i) {
      const double distance = (entry.tile.path[i] - p_local).norm();
      const double z_path_m = i < entry.tile.path_z_m.size() ? entry.tile.path_z_m[i] : 0.0;
      if (distance >= nearest || std::abs(entry.z_m.value_or(0.0) + z_path_m - *z_m) > kSameLevelM)
        continue;
      nearest = distance;
      layer = entry.layers.front();
    }
  }
  return layer;
}

std::vector<std::pair<int, OpenAir>> KnownSpace::open_air() const {
  std::vector<std::pair<int, OpenAir>> all;
  for (const auto& [id, entry] : entries_) {
    const auto T_map_local = pose_of(id);
    if (!T_map_local) continue;
    for (const OpenAir& open : entry.tile.open_air) {
      all.emplace_back(id, OpenAir{*T_map_local * open.p,
                                   *T_map_local * open.direction - T_map_local->translation()});
    }
  }
  return all;
}

std::optional<double> KnownSpace::height_near(const Eigen::Vector2d& p_atlas) const {
  const int layer = atlas_.layer_of(p_atlas);
  const Eigen::Vector2d p_map = atlas_.to_map(p_atlas);
  std::optional<double> height_m;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local || !entry.z_m || !entry.is_in(layer)) continue;
    const double distance = (entry.T_map_local->translation() - p_map).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    height_m = entry.z_m;
  }
  return height_m;
}

Eigen::Vector2d KnownSpace::in_own_layer(const Eigen::Vector2d& p_atlas) const {
  if (atlas_.layers() == 1) return p_atlas;
  const std::optional<PosedTile> tile = tile_at(p_atlas);
  if (!tile) return p_atlas;
  return atlas_.to_atlas(atlas_.to_map(p_atlas), entries_.at(tile->id).layers.front());
}

std::optional<Pose2> KnownSpace::pose_of(int id) const {
  const auto entry = entries_.find(id);
  if (entry == entries_.end() || !entry->second.T_map_local) return std::nullopt;
  return in_atlas(entry->second, entry->second.layers.front());
}

std::vector<Pose2> KnownSpace::poses_of(int id) const {
  std::vector<Pose2> poses;
  const auto entry = entries_.find(id);
  if (entry == entries_.end() || !entry->second.T_map_local) return poses;
  for (const int layer : entry->second.layers) poses.push_back(in_atlas(entry->second, layer));
  return poses;
}

std::optional<PosedTile> KnownSpace::newest() const {
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    if (const auto pose = pose_of(entry->first)) return PosedTile{entry->first, *pose};
  }
  return std::nullopt;
}

}  // namespace adit
