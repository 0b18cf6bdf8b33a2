// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/local_map_tile.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "common/geometry/attitude.hpp"
#include "common/grid/grid2.hpp"
#include "procs/exploration/map/layers.hpp"

namespace adit {
namespace {

constexpr double kPathRadiusMaxM =
    200.0;  // from the origin of a local map; a larger distance is an error

bool by_row(const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
  return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
}

bool is_valid(const LocalScan& local) {
  return local.T_local_body.vector().allFinite() &&
         local.T_local_body.translation().norm() < kPathRadiusMaxM &&
         std::isfinite(local.scan.angle_min_rad) && std::isfinite(local.scan.angle_step_rad);
}

const LaserMount* mount_of(const std::string& channel, const Lasers& lasers) {
  if (channel == "LASER_FRONT") return &lasers.front;
  return channel == "LASER_REAR" ? &lasers.rear : nullptr;
}

struct Counts {
  std::uint16_t ends = 0;      // scans that end in the cell
  std::uint16_t passes = 0;    // scans that traverse it and end elsewhere
  std::uint32_t last_end = 0;  // number of the scan
  std::uint32_t last_pass = 0;
  Eigen::Vector2f sum{0.0F, 0.0F};  // of the returns
  std::uint16_t returns = 0;
  bool steep = false;  // a return came from nearby
  float z_m = 0.0F;    // height of the last beam in it, above the origin of the local map
};

/// Heights of the beams of a scan: they lie in the plane of the body.
struct BeamPlane {
  double z_m = 0.0;  // at the origin of the local map
  Eigen::Vector2d slope_local{0.0, 0.0};

  explicit BeamPlane(const LocalScan& local) {
    const Pose2& T_local_body = local.T_local_body;
    if (local.attitude) {
      slope_local = T_local_body * ground_slope(*local.attitude) - T_local_body.translation();
    }
    z_m = local.z_m - slope_local.dot(T_local_body.translation());
  }
  [[nodiscard]] double height_m(const Eigen::Vector2d& p_local) const {
    return z_m + slope_local.dot(p_local);
  }
};

CellBox box_around(const LocalMap& map, const LocalMapTileParams& params) {
  CellBox box{cell_of(Eigen::Vector2d::Zero(), params.resolution_m), {1, 1}};
  const double reach_m = params.range_max_m + 5.0;  // lasers are mounted off the origin of body
  for (const LocalScan& local : map.scans) {
    const Eigen::Vector2d p = local.T_local_body.translation();
    const Eigen::Vector2d reach(reach_m, reach_m);
    box.from = box.from.cwiseMin(cell_of(p - reach, params.resolution_m));
    box.to = box.to.cwiseMax(cell_of(p + reach, params.resolution_m) + Eigen::Vector2i(1, 1));
  }
  return box;
}

/// Rasters scans one after the other. A scan counts once per cell, and does not traverse a cell in
/// which it ends.
class Raster {
 public:
  Raster(const LocalMap& map, const LocalMapTileParams& params)
      : params_(params), cells_(box_around(map, params)) {}

  void enter(const LocalScan& local, const LaserMount& mount, const Pose2& T_local_laser) {
    ++scan_;
    const LaserScan& scan = local.scan;
    const BeamPlane plane(local);
    for (const bool ends : {true, false}) {
      double angle = scan.angle_min_rad + T_local_laser.theta;
      for (const float range : scan.ranges_m) {
        const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
        angle += scan.angle_step_rad;
        if (!(range >= mount.range_min_m && range < mount.range_max_m)) continue;
        if (ends) end(T_local_laser.translation() + range * along, range, plane);
        if (!ends) carve(T_local_laser.translation(), along, range, plane);
      }
    }
  }

  void extract(LocalMapTile& tile) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Counts& counts = cells_[i];
      if (counts.ends > 0 && counts.ends >= params_.wall_share * (counts.ends + counts.passes)) {
        tile.walls.push_back({(counts.sum / counts.returns).cast<double>(), counts.steep});
      } else if (counts.passes > 0) {
        tile.free.push_back(cells_.cell(i));
      }
    }
    tile.footprint = footprint();
  }

 private:
  [[nodiscard]] std::vector<Eigen::Vector3d> footprint() const {
    struct Mean {
      double sum_m = 0.0;
      int cells = 0;
    };
    std::map<std::pair<int, int>, Mean> coarse;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].ends == 0 && cells_[i].passes == 0) continue;
      const Eigen::Vector2i cell =
          cell_of(centre_of(cells_.cell(i), params_.resolution_m), MapFootprint::kCellM);
      Mean& mean = coarse[{cell.x(), cell.y()}];
      mean.sum_m += cells_[i].z_m;
      ++mean.cells;
    }
    std::vector<Eigen::Vector3d> points;
    for (const auto& [cell, mean] : coarse) {
      const Eigen::Vector2d middle = centre_of({cell.first, cell.second}, MapFootprint::kCellM);
      points.emplace_back(middle.x(), middle.y(), mean.sum_m / mean.cells);
    }
    return points;
  }

  void end(const Eigen::Vector2d& p_local, double range, const BeamPlane& plane) {
    const Eigen::Vector2i cell = cell_of(p_local, params_.resolution_m);
    if (range > params_.range_max_m || !cells_.box().contains(cell)) return;
    Counts& counts = cells_[cells_.index(cell)];
    counts.sum += p_local.cast<float>();
    counts.z_m = static_cast<float>(plane.height_m(p_local));
    ++counts.returns;
    counts.steep |= range < params_.steep_range_m;
    if (counts.last_end != scan_) ++counts.ends;
    counts.last_end = scan_;
  }

  /// Marks the traversed cells in steps of half a cell, up to half a cell before the return.
  void carve(const Eigen::Vector2d& from, const Eigen::Vector2d& along, double range,
             const BeamPlane& plane) {
    const double half = params_.resolution_m / 2.0;
    const double until = std::min(range - half, params_.range_max_m);
    for (double range_m = 0.0; range_m < until; range_m += half) {
      const Eigen::Vector2d p_local = from + range_m * along;
      const Eigen::Vector2i cell = cell_of(p_local, params_.resolution_m);
      if (!cells_.box().contains(cell)) return;
      Counts& counts = cells_[cells_.index(cell)];
      if (counts.last_end == scan_ || counts.last_pass == scan_) continue;
      counts.last_pass = scan_;
      counts.z_m = static_cast<float>(plane.height_m(p_local));
      ++counts.passes;
    }
  }

  LocalMapTileParams params_;
  Grid2<Counts> cells_;
  std::uint32_t scan_ = 0;
};

/// The widest opening of a scan; empty if there is none.
std::optional<OpenAir> open_air_of(const LaserScan& scan, const LaserMount& mount,
                                   const Pose2& T_local_laser) {
  constexpr double kLeastRad = 0.5;  // a hall of 25 m at a range of 50 m
  std::size_t widest = 0;
  std::size_t end = 0;
  std::size_t adjacent = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    adjacent = static_cast<double>(scan.ranges_m[i]) >= mount.range_max_m ? adjacent + 1 : 0;
    if (adjacent <= widest) continue;
    widest = adjacent;
    end = i + 1;
  }
  if (static_cast<double>(widest) * std::abs(scan.angle_step_rad) < kLeastRad) return std::nullopt;
  const double middle = static_cast<double>(end) - 0.5 * static_cast<double>(widest + 1);
  const double angle = scan.angle_min_rad + middle * scan.angle_step_rad + T_local_laser.theta;
  return OpenAir{T_local_laser.translation(), {std::cos(angle), std::sin(angle)}};
}

bool is_new_view(const Pose2& T_local_last, const Pose2& T_local_laser,
                 const LocalMapTileParams& params) {
  const Pose2 moved = between(T_local_last, T_local_laser);
  return moved.translation().norm() >= params.view_distance_m ||
         std::abs(moved.theta) >= params.view_angle_rad;
}

}  // namespace

bool LocalMapTile::is_free(const Eigen::Vector2i& cell_local) const {
  return std::binary_search(free.begin(), free.end(), cell_local, by_row);
}

std::optional<LocalMapTile> make_local_map_tile(const LocalMap& map, const Lasers& lasers,
                                                const LocalMapTileParams& params) {
  if (map.scans.empty() || !std::all_of(map.scans.begin(), map.scans.end(), is_valid)) {
    return std::nullopt;
  }
  LocalMapTile tile;
  tile.session = map.session;
  tile.end_utime = map.end_utime;
  Raster raster(map, params);
  std::map<std::string, Pose2> last_view;
  for (const LocalScan& local : map.scans) {
    tile.path.push_back(local.T_local_body.translation());
    tile.path_z_m.push_back(local.z_m);
    const LaserMount* mount = mount_of(local.channel, lasers);
    if (mount == nullptr) continue;
    const Pose2 T_local_laser = local.T_local_body * mount->T_body_laser;
    const auto last = last_view.find(local.channel);
    if (last != last_view.end() && !is_new_view(last->second, T_local_laser, params)) continue;
    last_view[local.channel] = T_local_laser;
    raster.enter(local, *mount, T_local_laser);
    if (const auto open = open_air_of(local.scan, *mount, T_local_laser))
      tile.open_air.push_back(*open);
  }
  raster.extract(tile);
  return tile;
}

}  // namespace adit
