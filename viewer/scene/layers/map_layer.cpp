// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/map_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kGridPeriodUs = 2'000'000;
constexpr int kRecentCellsMax = 4'000'000;
constexpr double kExtentMaxM = 20'000.0;  // what lies farther from the start is not drawn
constexpr std::uint8_t kUnknown = 255;
constexpr double kOccupiedPercent = 65.0;  // that of OccupancyGrid::kOccupiedShare

/// The box in cells of `cell_m` around a raster at a pose.
CellBox placed_box(const MapRaster& raster, const Pose2& T_map_raster, double cell_m) {
  const CellBox& box = raster.cells.box();
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const Eigen::Vector2i& corner : {box.from, box.to, Eigen::Vector2i(box.from.x(), box.to.y()),
                                        Eigen::Vector2i(box.to.x(), box.from.y())}) {
    const Eigen::Vector2d p_raster = raster.cell_m * corner.cast<double>();
    const Eigen::Vector2d p_map = T_map_raster * p_raster;
    low = low.cwiseMin(p_map);
    high = high.cwiseMax(p_map);
  }
  if (!(low.cwiseAbs().maxCoeff() < kExtentMaxM && high.cwiseAbs().maxCoeff() < kExtentMaxM))
    return {};
  return {cell_of(low, cell_m), cell_of(high, cell_m) + Eigen::Vector2i(1, 1)};
}

/// Calls `take` with each cell of `grid` and the raster's cell at its centre.
template <class Sums, class Take>
void draw(const MapRaster& raster, const Pose2& T_map_raster, double cell_m, Sums& sums,
          Take take) {
  const CellBox box = placed_box(raster, T_map_raster, cell_m);
  const Pose2 T_raster_map = T_map_raster.inverse();
  for (int row = box.from.y(); row < box.to.y(); ++row) {
    for (int column = box.from.x(); column < box.to.x(); ++column) {
      const Eigen::Vector2i cell(column, row);
      const Eigen::Vector2d p_raster = T_raster_map * centre_of(cell, cell_m);
      const Eigen::Vector2i of_raster = cell_of(p_raster, raster.cell_m);
      if (!raster.cells.contains(of_raster) || !sums.contains(cell)) continue;
      take(sums.at(cell), raster.cells.at(of_raster));
    }
  }
}

/// From 0 to 100; kOccupiedPercent and above is wall.
std::uint8_t occupancy_percent(double share_of_hits) {
  constexpr double kLimit = OccupancyGrid::kOccupiedShare;
  const double percent = share_of_hits < kLimit
                             ? (kOccupiedPercent - 1.0) * share_of_hits / kLimit
                             : kOccupiedPercent + (100.0 - kOccupiedPercent) *
                                                      (share_of_hits - kLimit) / (1.0 - kLimit);
  return static_cast<std::uint8_t>(std::lround(percent));
}

/// Red, green, blue, alpha for viewers that show colours.
std::array<std::uint8_t, 4> color_of(std::uint8_t occupancy, Coverage coverage) {
  if (occupancy == kUnknown) return {0, 0, 0, 0};
  if (occupancy >= kOccupiedPercent) return {30, 30, 30, 255};
  if (coverage == Coverage::kDriven) return {190, 215, 240, 255};
  if (coverage == Coverage::kScanned) return {245, 245, 245, 255};
  return {225, 225, 225, 255};
}

}  // namespace

MapLayer::MapLayer(TopicBoard& board, const MapFrame& frame, const AnchoredPath& path,
                   const SceneParameters& parameters)
    : board_(board),
      frame_(frame),
      path_(path),
      parameters_(parameters),
      cell_m_(parameters.map_cell_m),
      recent_({.resolution_m = parameters.map_cell_m, .cells_max = kRecentCellsMax}) {
  topic_ = board.add(protobuf_topic("/map", *foxglove::Grid::descriptor(), kGridPeriodUs),
                     [this] { return grid_message(); });
}

void MapLayer::add_local_map(const LocalMap& map, const Lasers& lasers) {
  if (local_maps_.empty() || map.id > local_maps_.rbegin()->first) {
    recent_ = OccupancyGrid({.resolution_m = cell_m_, .cells_max = kRecentCellsMax});
    T_odom_recent_.reset();
  }
  MapRaster& raster = local_maps_[map.id];
  bytes_ -= raster.bytes();
  raster = rasterised(map, lasers, cell_m_);
  utime_ = std::max(utime_, map.end_utime);
  add_bytes(raster.bytes());
  set_changed(utime_);
}

/// What hit the ground is not a wall.
void MapLayer::add_scan(const ScanMatch& match, const LaserScan& scan, const LaserMount& mount) {
  constexpr double kStepM = 0.1;  // as for the scans of a local map
  constexpr double kStepRad = 0.1;
  if (match.status != ScanMatch::Status::kMatched) return;
  if (T_odom_recent_) {
    const Pose2 step = between(*T_odom_recent_, match.T_odom_body);
    if (step.translation().norm() < kStepM && std::abs(step.theta) < kStepRad) return;
  }
  LaserScan walls = scan;
  for (const std::int32_t beam : match.ground_beams) {
    const auto index = static_cast<std::size_t>(beam);
    if (beam >= 0 && index < walls.ranges_m.size()) walls.ranges_m[index] = 0.0F;
  }
  if (!recent_.insert(walls, match.T_odom_body * mount.T_body_laser)) return;
  T_odom_recent_ = match.T_odom_body;
  utime_ = std::max(utime_, match.utime);
  set_changed(utime_);
}

void MapLayer::add_terrain(const TerrainMap& terrain) {
  scanned_.push_back({frame_.anchored({terrain.T_odom_level, 0.0}), rasterised(terrain, cell_m_)});
  utime_ = std::max(utime_, terrain.utime);
  add_bytes(scanned_.back().raster.bytes());
  set_changed(utime_);
}

void MapLayer::add_bytes(std::size_t bytes) {
  bytes_ += bytes;
  if (bytes_ <= kRasterBytesMax) return;
  cell_m_ *= 2.0;
  bytes_ = 0;
  for (auto& [id, raster] : local_maps_) {
    raster = halved(raster);
    bytes_ += raster.bytes();
  }
  for (Scanned& scan : scanned_) {
    scan.raster = halved(scan.raster);
    bytes_ += scan.raster.bytes();
  }
}

template <class Draw>
void MapLayer::for_each_raster(Draw draw_raster) const {
  for (const auto& [id, raster] : local_maps_) {
    if (const auto T_map_local = frame_.T_map_local(id)) draw_raster(raster, T_map_local->plan);
  }
  if (T_odom_recent_) draw_raster(rasterised(recent_), frame_.T_map_odom().plan);
  for (const Scanned& scan : scanned_) draw_raster(scan.raster, frame_.T_map(scan.T_level).plan);
}

CellBox MapLayer::covered_box(double cell_m) const {
  CellBox box;
  for_each_raster([&](const MapRaster& raster, const Pose2& T_map_raster) {
    box = united(box, placed_box(raster, T_map_raster, cell_m));
  });
  return box;
}

/// The floor below the vehicle, as a disc around its origin.
void MapLayer::draw_path(Grid2<Sum>& sums, double cell_m) const {
  const double radius_m = 0.5 * parameters_.vehicle.width_m;
  const int reach = static_cast<int>(std::ceil(radius_m / cell_m));
  for (const AnchoredPath::Pose& pose : path_.poses()) {
    const Eigen::Vector2d p_map = frame_.T_map(pose.anchored).plan.translation();
    if (!(p_map.cwiseAbs().maxCoeff() < kExtentMaxM)) continue;
    const Eigen::Vector2i middle = cell_of(p_map, cell_m);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Eigen::Vector2i cell = middle + Eigen::Vector2i(dx, dy);
        if (!sums.contains(cell) || (centre_of(cell, cell_m) - p_map).norm() > radius_m) continue;
        sums.at(cell).coverage = Coverage::kDriven;
      }
    }
  }
}

std::string MapLayer::grid_message() const {
  double cell_m = cell_m_;
  CellBox box = covered_box(cell_m);
  while (box.count() > static_cast<std::size_t>(parameters_.map_cells_max)) {
    cell_m *= 2.0;
    box = covered_box(cell_m);
  }
  if (box.empty()) return {};
  Grid2<Sum> sums(box);
  for_each_raster([&](const MapRaster& raster, const Pose2& T_map_raster) {
    draw(raster, T_map_raster, cell_m, sums, [](Sum& sum, const MapRaster::Cell& cell) {
      sum.hits += cell.hits;
      sum.misses += cell.misses;
      sum.coverage = std::max(sum.coverage, cell.coverage);
    });
  });
  draw_path(sums, cell_m);

  foxglove::Grid message;
  constexpr std::uint32_t kStride = 6;
  values::set_time(*message.mutable_timestamp(), utime_);
  message.set_frame_id("map");
  values::set_pose(*message.mutable_pose(),
                   LevelPose{{cell_m * box.from.x(), cell_m * box.from.y(), 0.0}, 0.0});
  message.set_column_count(static_cast<std::uint32_t>(box.size().x()));
  message.mutable_cell_size()->set_x(cell_m);
  message.mutable_cell_size()->set_y(cell_m);
  message.set_row_stride(kStride * static_cast<std::uint32_t>(box.size().x()));
  message.set_cell_stride(kStride);
  std::uint32_t offset = 0;
  for (const char* name : {"red", "green", "blue", "alpha", "occupancy", "coverage"})
    values::add_field(message, name, offset++, foxglove::PackedElementField::UINT8);
  std::string& data = *message.mutable_data();
  data.reserve(kStride * sums.size());
  for (const Sum& sum : sums) {
    const std::uint32_t scans = sum.hits + sum.misses;
    const std::uint8_t occupancy =
        scans == 0 ? kUnknown : occupancy_percent(static_cast<double>(sum.hits) / scans);
    for (const std::uint8_t byte : color_of(occupancy, sum.coverage))
      data.push_back(static_cast<char>(byte));
    data.push_back(static_cast<char>(occupancy));
    data.push_back(static_cast<char>(sum.coverage));
  }
  return message.SerializeAsString();
}

}  // namespace adit
