// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/change_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/grid/grid2.hpp"
#include "tools/survey/files/contour_lines.hpp"

namespace adit {
namespace {

constexpr std::array<SurfaceKind, 3> kKinds{SurfaceKind::kFloor, SurfaceKind::kRoof,
                                            SurfaceKind::kWall};

/// A raster without bands over cells of comparison.
Raster raster_of(const CellBox& box, const Eigen::Vector3d& origin, double cell_m) {
  Raster raster;
  raster.columns = box.size().x();
  raster.rows = box.size().y();
  raster.cell_m = cell_m;
  raster.north_west = origin.head<2>() + cell_m * Eigen::Vector2d(box.from.x(), box.to.y());
  return raster;
}

/// Position of a cell in a band, rows from the north.
std::size_t position(const CellBox& box, const Eigen::Vector2i& cell) {
  const auto row = static_cast<std::size_t>(box.to.y() - 1 - cell.y());
  return row * static_cast<std::size_t>(box.size().x()) +
         static_cast<std::size_t>(cell.x() - box.from.x());
}

/// The cells of points, with a rim.
template <class Places>
CellBox box_around(const Places& places, double cell_m) {
  CellBox box;
  for (const Eigen::Vector3d& p : places) {
    const Eigen::Vector2i cell = cell_of(p.head<2>(), cell_m);
    box = united(box, CellBox{cell.array() - 1, cell.array() + 2});
  }
  return box;
}

std::vector<VectorFeature> outlines_of(const ChangeRegion& region, std::int64_t number,
                                       const std::vector<SurfaceDistance>& distances,
                                       const Eigen::Vector3d& origin, double cell_m) {
  std::vector<Eigen::Vector3d> places;
  for (const std::size_t core : region.cores) places.push_back(distances[core].p);
  const CellBox box = box_around(places, cell_m);
  Raster raster = raster_of(box, origin, cell_m);
  RasterBand band{"change", "", std::vector<float>(box.count(), 0.0F)};
  for (const Eigen::Vector3d& p : places)
    band.values[position(box, cell_of(p.head<2>(), cell_m))] = 1.0F;
  raster.bands.push_back(std::move(band));
  std::vector<VectorFeature> features;
  for (const ContourLine& line : contour_lines(raster, 0.5, 1.0)) {
    VectorFeature feature{{}, {number}, ""};
    for (const Eigen::Vector2d& p : line.points)
      feature.points.emplace_back(p.x(), p.y(), origin.z() + region.p.z());
    features.push_back(std::move(feature));
  }
  return features;
}

}  // namespace

Raster change_raster(const std::vector<SurfaceDistance>& distances, const Eigen::Vector3d& origin,
                     double cell_m) {
  std::vector<Eigen::Vector3d> places;
  for (const SurfaceDistance& at : distances) {
    if (at.is_measured()) places.push_back(at.p);
  }
  const CellBox box = box_around(places, cell_m);
  Raster raster = raster_of(box, origin, cell_m);
  for (const SurfaceKind kind : kKinds) {
    RasterBand change{fmt::format("{}: distance, positive into the void", name_of(kind)), "m", {}};
    change.values.assign(box.count(), std::numeric_limits<float>::quiet_NaN());
    RasterBand level{fmt::format("{}: level of detection, 95 %", name_of(kind)), "m", {}};
    level.values = change.values;
    for (const SurfaceDistance& at : distances) {
      if (!at.is_measured() || kind_of(at.n) != kind) continue;
      const std::size_t cell = position(box, cell_of(at.p.head<2>(), cell_m));
      const double ratio = std::abs(at.distance_m) / at.detection_m();
      const double shown = std::abs(change.values[cell]) / level.values[cell];
      if (std::isfinite(shown) && shown >= ratio) continue;
      change.values[cell] = static_cast<float>(at.distance_m);
      level.values[cell] = static_cast<float>(at.detection_m());
    }
    raster.bands.push_back(std::move(change));
    raster.bands.push_back(std::move(level));
  }
  return raster;
}

std::vector<VectorLayer> change_layers(const std::vector<ChangeRegion>& regions,
                                       const std::vector<SurfaceDistance>& distances,
                                       const Eigen::Vector3d& origin, double cell_m) {
  using Type = VectorLayer::Field::Type;
  VectorLayer points{"changes",
                     VectorLayer::Geometry::kPoint,
                     {{"change", Type::kInteger},
                      {"surface", Type::kText},
                      {"meaning", Type::kText},
                      {"mean_m", Type::kNumber},
                      {"most_m", Type::kNumber},
                      {"area_m2", Type::kNumber},
                      {"volume_m3", Type::kNumber},
                      {"volume_sd_m3", Type::kNumber}},
                     {}};
  VectorLayer outlines{
      "change_outlines", VectorLayer::Geometry::kLine, {{"change", Type::kInteger}}, {}};
  std::int64_t number = 0;
  for (const ChangeRegion& region : regions) {
    ++number;
    points.features.push_back(
        {{origin + region.p},
         {number, std::string(name_of(region.kind)), std::string(region.meaning()), region.mean_m,
          region.most_m, region.area_m2, region.volume_m3, region.volume_sd_m3},
         fmt::format("{}: {:+.2f} m³", number, region.volume_m3)});
    for (VectorFeature& outline : outlines_of(region, number, distances, origin, cell_m))
      outlines.features.push_back(std::move(outline));
  }
  return {std::move(points), std::move(outlines)};
}

std::string change_table(const std::vector<ChangeRegion>& regions, const Eigen::Vector3d& origin) {
  std::string table =
      "change,x_m,y_m,z_m,surface,mean_m,most_m,area_m2,volume_m3,volume_sd_m3,meaning\n";
  int number = 0;
  for (const ChangeRegion& region : regions) {
    const Eigen::Vector3d p = origin + region.p;
    fmt::format_to(std::back_inserter(table),
                   "{},{:.3f},{:.3f},{:.3f},{},{:.3f},{:.3f},{:.2f},{:.3f},{:.3f},{}\n", ++number,
                   p.x(), p.y(), p.z(), name_of(region.kind), region.mean_m, region.most_m,
                   region.area_m2, region.volume_m3, region.volume_sd_m3,
                   std::string("\"").append(region.meaning()).append("\""));
  }
  return table;
}

}  // namespace adit
