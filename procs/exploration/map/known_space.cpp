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

}  // namespace

void KnownSpace::add(int id, LocalMapTile tile) {
  Entry& entry = entries_[id];
  withdraw(entry);
  entry.radius_m = radius_of(tile, resolution_m());
  entry.tile = std::move(tile);
}

void KnownSpace::add(ScannedGround ground) {
  ground_.push_back(std::move(ground));
  T_map_level_.emplace_back();
  dropped_tiles_ += enter_ground(ground_.size() - 1) ? 0 : 1;
}

void KnownSpace::clear_scanned_ground() {
  for (std::size_t i = 0; i < ground_.size(); ++i) withdraw_ground(i);
  ground_.clear();
  T_map_level_.clear();
}

void KnownSpace::pose(const std::vector<Pose2>& T_map_local) {
  dropped_tiles_ = 0;
  for (auto& [id, entry] : entries_) {
    const bool posed = id >= 0 && static_cast<std::size_t>(id) < T_map_local.size();
    if (!posed) {
      withdraw(entry);
      continue;
    }
    const Pose2& pose = T_map_local[static_cast<std::size_t>(id)];
    if (!moved(entry.T_map_local, pose, entry.radius_m)) continue;
    withdraw(entry);
    enter(entry, pose);
  }
  for (std::size_t i = 0; i < ground_.size(); ++i) dropped_tiles_ += enter_ground(i) ? 0 : 1;
}

/// Whether what voted at a pose must vote again.
bool KnownSpace::moved(const std::optional<Pose2>& T_map_voted, const Pose2& T_map,
                       double radius_m) const {
  if (!T_map_voted) return true;
  const Pose2 motion = between(*T_map_voted, T_map);
  return motion.translation().norm() + radius_m * std::abs(motion.theta) >
         params_.update_distance_m;
}

void KnownSpace::enter(Entry& entry, const Pose2& T_map_local) {
  if (!reserve(T_map_local, entry.radius_m)) {
    ++dropped_tiles_;
    return;
  }
  entry.T_map_local = T_map_local;
  vote(entry, 1);
}

void KnownSpace::withdraw(Entry& entry) {
  if (!entry.T_map_local) return;
  vote(entry, -1);
  entry.T_map_local.reset();
}

/// Makes room around a pose. Returns false if the pose is invalid or the grid would become too
/// large.
bool KnownSpace::reserve(const Pose2& T_map, double radius_m) {
  const Eigen::Vector2d p = T_map.translation();
  if (!T_map.vector().allFinite() || p.norm() >= 1e6) return false;
  const Eigen::Vector2d reach(radius_m, radius_m);
  const CellBox box{cell_of(p - reach, resolution_m()),
                    cell_of(p + reach, resolution_m()) + Eigen::Vector2i(1, 1)};
  if (votes_.size() > 0 && votes_.box().contains(box)) return true;
  const Eigen::Vector2i slack(kSlack, kSlack);
  CellBox grown_box{box.from - slack, box.to + slack};
  if (votes_.size() > 0) {
    grown_box.from = grown_box.from.cwiseMin(votes_.box().from);
    grown_box.to = grown_box.to.cwiseMax(votes_.box().to);
  }
  const double cells = grown_box.size().cast<double>().prod();
  if (cells > params_.cells_max) return false;
  votes_ = votes_.size() > 0 ? votes_.grown_to(grown_box) : Grid2<Votes>(grown_box);
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
  PlacedVotes placed(votes_, *entry.T_map_local, resolution_m());
  for (const Eigen::Vector2i& cell : entry.tile.free) placed.add(cell, &Votes::free, sign);
  for (const WallCell& wall : entry.tile.walls) {
    Votes& votes = placed.at(wall.p_local.x(), wall.p_local.y());
    votes.wall = static_cast<std::uint16_t>(votes.wall + sign * kVotesOfCell);
    if (wall.steep) votes.steep_wall = static_cast<std::uint16_t>(votes.steep_wall + sign);
  }
}

/// Votes at the present pose of its local map, if it has one. Returns false if the grid would
/// become too large.
bool KnownSpace::enter_ground(std::size_t i) {
  const ScannedGround& ground = ground_[i];
  const std::optional<Pose2> T_map_local = pose_of(ground.local_map);
  const auto T_map_level =
      T_map_local ? std::optional(*T_map_local * ground.T_local_level) : std::nullopt;
  const CellBox& box = ground.cells.box();
  const double radius_m =
      resolution_m() * (box.from.cwiseAbs().cwiseMax(box.to.cwiseAbs())).cast<double>().norm();
  if (T_map_level && !moved(T_map_level_[i], *T_map_level, radius_m)) return true;
  withdraw_ground(i);
  if (!T_map_level) return true;
  if (!reserve(*T_map_level, radius_m)) return false;
  T_map_level_[i] = T_map_level;
  vote_ground(i, 1);
  return true;
}

void KnownSpace::withdraw_ground(std::size_t i) {
  if (!T_map_level_[i]) return;
  vote_ground(i, -1);
  T_map_level_[i].reset();
}

void KnownSpace::vote_ground(std::size_t i, int sign) {
  const Grid2<ScannedCell>& cells = ground_[i].cells;
  PlacedVotes placed(votes_, *T_map_level_[i], resolution_m());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (cells[k] == ScannedCell::kUnknown) continue;
    const auto count = cells[k] == ScannedCell::kGround ? &Votes::ground : &Votes::rock;
    placed.add(cells.cell(k), count, sign);
  }
}

/// Whether the wall in a cell is too steep for ground, or 3D scans observed rock within two cells.
bool KnownSpace::is_confirmed_wall(std::size_t votes_index) const {
  if (votes_[votes_index].steep_wall > 0) return true;
  constexpr int kReach = 2;
  const Eigen::Vector2i middle = votes_.cell(votes_index);
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      if (votes_.get(middle + Eigen::Vector2i(x, y)).rock > 0) return true;
    }
  }
  return false;
}

bool KnownSpace::has_returns(std::size_t votes_index) const {
  const Votes& votes = votes_[votes_index];
  return votes.wall > 0 && kFreeOverWall * votes.wall >= votes.free;
}

Occupancy KnownSpace::occupancy(std::size_t votes_index, Walls walls) const {
  const Votes& votes = votes_[votes_index];
  if (votes.free == 0 && votes.wall == 0) return Occupancy::kUnseen;
  const bool on_ground = votes.ground > 0 && votes.rock == 0;
  if (!has_returns(votes_index) || on_ground) return Occupancy::kFree;
  const bool counts = walls == Walls::kAll || ground_.empty() || is_confirmed_wall(votes_index);
  return counts ? Occupancy::kWall : Occupancy::kUnseen;
}

bool KnownSpace::dismisses_wall_near(const Eigen::Vector2d& p_map, Walls walls) const {
  constexpr int kReach = 3;
  const Eigen::Vector2i middle = cell_of(p_map, resolution_m());
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
      if (!votes_.contains(cell)) continue;
      const std::size_t i = votes_.index(cell);
      if (has_returns(i) && occupancy(i, walls) != Occupancy::kWall) return true;
    }
  }
  return false;
}

Grid2<Occupancy> KnownSpace::cells(Walls walls) const {
  CellBox box = votes_.box();
  if (votes_.size() == 0) return {};
  const Eigen::Vector2i rim(kRim, kRim);
  Grid2<Occupancy> known({box.from - rim, box.to + rim}, Occupancy::kUnseen);
  for (std::size_t i = 0; i < votes_.size(); ++i) {
    known[known.index(votes_.cell(i))] = occupancy(i, walls);
  }
  fill_patches(known);
  mark_driven(known);
  return known;
}

/// Marks the path of the body as driven, across the seams of local maps too, where scans may leave
/// gaps. Within a known area mapping adds no local maps, so that the next one begins elsewhere:
/// such a jump is not a path.
void KnownSpace::mark_driven(Grid2<Occupancy>& known) const {
  Eigen::Vector2d last(0.0, 0.0);
  std::optional<int> session;
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local) continue;
    for (const Eigen::Vector2d& p_local : entry.tile.path) {
      const Eigen::Vector2d p = *entry.T_map_local * p_local;
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

std::optional<PosedTile> KnownSpace::tile_at(const Eigen::Vector2d& p_map) const {
  std::optional<PosedTile> best;
  double nearest = kAnchorRadiusM;
  for (const auto& [id, entry] : entries_) {
    if (!entry.T_map_local) continue;
    const Eigen::Vector2d p_local = entry.T_map_local->inverse() * p_map;
    double distance = std::numeric_limits<double>::infinity();
    for (const auto& p : entry.tile.path) distance = std::min(distance, (p - p_local).norm());
    if (distance >= nearest || !entry.tile.is_free(cell_of(p_local, resolution_m()))) continue;
    nearest = distance;
    best = {id, *entry.T_map_local};
  }
  return best;
}

std::optional<int> KnownSpace::newest_at(const Eigen::Vector2d& p_map) const {
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    const auto& [tile, T_map_local, radius_m] = entry->second;
    if (!T_map_local) continue;
    if (tile.is_free(cell_of(T_map_local->inverse() * p_map, resolution_m()))) return entry->first;
  }
  return std::nullopt;
}

std::optional<Pose2> KnownSpace::pose_of(int id) const {
  const auto entry = entries_.find(id);
  return entry == entries_.end() ? std::nullopt : entry->second.T_map_local;
}

std::optional<PosedTile> KnownSpace::newest() const {
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    if (entry->second.T_map_local) return PosedTile{entry->first, *entry->second.T_map_local};
  }
  return std::nullopt;
}

}  // namespace adit
