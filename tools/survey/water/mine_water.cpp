// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/water/mine_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"
#include "tools/survey/files/contour_lines.hpp"

namespace adit {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSeenAreaMinM2 = 0.5;
constexpr double kFloodedAreaMinM2 = 0.5;
constexpr double kFloorSdM = 0.02;  // of a floor whose own is unknown: interpolated
constexpr int kShoreCells = 2;
constexpr std::size_t kShoreMin = 5;  // cells of a shore whose level counts
constexpr const char* kWaterHazard = "water";

const std::array<Eigen::Vector2i, 8> kBesideCell{Eigen::Vector2i(1, 0),  Eigen::Vector2i(1, 1),
                                                 Eigen::Vector2i(0, 1),  Eigen::Vector2i(-1, 1),
                                                 Eigen::Vector2i(-1, 0), Eigen::Vector2i(-1, -1),
                                                 Eigen::Vector2i(0, -1), Eigen::Vector2i(1, -1)};

bool is_void_column(const SurveyColumn& column) {
  return column.kind == SurveyColumn::Kind::kVoid && std::isfinite(column.floor_m);
}

bool continues(const ColumnGrid& filled, const OccupancyGrid* free_space,
               const Eigen::Vector2i& cell) {
  if (filled.columns.get(cell).kind != SurveyColumn::Kind::kUnseen) return false;
  return free_space == nullptr ||
         free_space->state(free_space->cell_at(centre_of(cell, filled.cell_m))) !=
             CellState::kOccupied;
}

/// Sets the cells of groups that are narrower than `cells_min` to 0.
void remove_narrow(Grid2<std::uint8_t>& outlets, int cells_min) {
  Grid2<std::uint8_t> seen(outlets.box());
  for (std::size_t i = 0; i < outlets.size(); ++i) {
    if (outlets[i] == 0 || seen[i] != 0) continue;
    std::vector<Eigen::Vector2i> group{outlets.cell(i)};
    seen[i] = 1;
    CellBox box;
    for (std::size_t k = 0; k < group.size(); ++k) {
      box = united(box, group[k]);
      const Eigen::Vector2i at = group[k];
      for (const Eigen::Vector2i& step : kBesideCell) {
        const Eigen::Vector2i next = at + step;
        if (outlets.get(next, 0) == 0 || seen.at(next) != 0) continue;
        seen.at(next) = 1;
        group.push_back(next);
      }
    }
    if (box.size().maxCoeff() >= cells_min) continue;
    for (const Eigen::Vector2i& cell : group) outlets.at(cell) = 0;
  }
}

/// The median standard deviation of the floor of cells.
double floor_sd_m(const ColumnGrid& filled, const std::vector<Eigen::Vector2i>& cells) {
  std::vector<double> sds;
  for (const Eigen::Vector2i& cell : cells) {
    const SurveyColumn& column = filled.columns.at(cell);
    if (std::isfinite(column.floor_sd_m)) sds.push_back(column.floor_sd_m);
  }
  return sds.empty() ? kFloorSdM : median(std::move(sds));
}

/// The body at a level that is off by `shift_m`: its own cells and those of its shore.
WaterBody moved(const FloodGround& ground, const WaterBody& body, double shift_m) {
  const auto bodies = flooded_at(ground, body.level_m + shift_m, 0.0);
  WaterBody sum;
  for (const WaterBody& other : bodies) {
    const bool same = std::ranges::any_of(other.cells, [&](const Eigen::Vector2i& cell) {
      return std::ranges::binary_search(body.cells, cell, [](const auto& a, const auto& b) {
        return std::pair(a.y(), a.x()) < std::pair(b.y(), b.x());
      });
    });
    if (!same) continue;
    sum.area_m2 += other.area_m2;
    sum.volume_m3 += other.volume_m3;
    sum.depth_m = std::max(sum.depth_m, other.depth_m);
  }
  return sum;
}

SurveyedWater surveyed(SurveyedWater::Kind kind, WaterBody body, const FloodGround& ground,
                       const ColumnGrid& filled) {
  std::ranges::sort(body.cells, {},
                    [](const Eigen::Vector2i& cell) { return std::pair(cell.y(), cell.x()); });
  SurveyedWater water{kind, std::move(body)};
  water.level_sd_m = floor_sd_m(filled, water.body.cells);
  const WaterBody low = moved(ground, water.body, -water.level_sd_m);
  const WaterBody high = moved(ground, water.body, water.level_sd_m);
  const auto sd = [](double less, double value, double more) {
    return std::max(std::abs(value - less), std::abs(more - value));
  };
  // What lies above the pass of a hollow runs off: only lowering it counts.
  const WaterBody& most = kind == SurveyedWater::Kind::kHollow ? water.body : high;
  water.area_m2 = {water.body.area_m2, sd(low.area_m2, water.body.area_m2, most.area_m2)};
  water.volume_m3 = {water.body.volume_m3, sd(low.volume_m3, water.body.volume_m3, most.volume_m3)};
  water.depth_m = {water.body.depth_m, water.level_sd_m};
  return water;
}

/// The cells of a hazard in the plan without a return of the floor.
std::vector<Eigen::Vector2i> cells_without_floor(const ColumnGrid& columns,
                                                 const ColumnGrid& filled, const HazardMark& mark) {
  const Eigen::Vector2d half = 0.5 * mark.hazard.size_m;
  const Pose2& T_survey_centre = mark.T_survey_centre.plan;
  const int reach = static_cast<int>(std::ceil(half.norm() / columns.cell_m));
  const Eigen::Vector2i middle = cell_of(T_survey_centre.translation(), columns.cell_m);
  const Pose2 T_centre_survey = T_survey_centre.inverse();
  std::vector<Eigen::Vector2i> cells;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
      if (!columns.columns.contains(cell)) continue;
      const Eigen::Vector2d p = T_centre_survey * centre_of(cell, columns.cell_m);
      if ((p.cwiseAbs().array() > half.array()).any()) continue;
      const SurveyColumn& column = columns.columns.at(cell);
      const bool wall = column.kind == SurveyColumn::Kind::kWall;
      const bool known = filled.columns.at(cell).kind == SurveyColumn::Kind::kVoid;
      if (!wall && known && !std::isfinite(column.floor_m)) cells.push_back(cell);
    }
  }
  return cells;
}

/// Water that stands at a hazard; nothing where it is small or has no shore.
std::optional<SurveyedWater> standing_water(const ColumnGrid& columns, const ColumnGrid& filled,
                                            const HazardMark& mark) {
  SurveyedWater water;
  water.kind = SurveyedWater::Kind::kSeen;
  water.body.cells = cells_without_floor(columns, filled, mark);
  const double cell_m2 = columns.cell_m * columns.cell_m;
  water.body.area_m2 = cell_m2 * static_cast<double>(water.body.cells.size());
  if (water.body.area_m2 < kSeenAreaMinM2) return std::nullopt;
  std::vector<double> shore;
  std::size_t rim = 0;
  for (const Eigen::Vector2i& cell : water.body.cells) {
    bool at_shore = false;
    for (const Eigen::Vector2i& step : kBesideCell) {
      const SurveyColumn beside = columns.columns.get(cell + kShoreCells * step);
      if (!is_void_column(beside)) continue;
      shore.push_back(beside.floor_m);
      at_shore = true;
    }
    if (at_shore) ++rim;
  }
  if (shore.size() < kShoreMin) return std::nullopt;
  const double level_m = median(shore);
  const double spread_m = 0.5 * (quantile(shore, 0.84) - quantile(shore, 0.16));
  water.body.level_m = level_m;
  water.body.deepest = mark.T_survey_centre.plan.translation();
  water.level_sd_m = std::hypot(spread_m, kFloorSdM);
  water.area_m2 = {water.body.area_m2, 0.5 * cell_m2 * static_cast<double>(rim)};
  water.volume_m3 = {kNone, kNone};
  water.depth_m = {kNone, kNone};
  return water;
}

std::string csv(double value, int digits = 3) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string();
}

/// The outlines of the cells of a body, in the grid.
std::vector<std::vector<Eigen::Vector2d>> rings_of(const WaterBody& body, const SurveyFrame& frame,
                                                   double cell_m) {
  CellBox box;
  for (const Eigen::Vector2i& cell : body.cells)
    box = united(box, CellBox{cell.array() - 1, cell.array() + 2});
  Raster raster;
  raster.columns = box.size().x();
  raster.rows = box.size().y();
  raster.cell_m = frame.scale() * cell_m;
  raster.north_west = frame.in_grid(Eigen::Vector2d(cell_m * box.from.x(), cell_m * box.to.y()));
  RasterBand band{"water", "", std::vector<float>(box.count(), 0.0F)};
  for (const Eigen::Vector2i& cell : body.cells) {
    const auto row = static_cast<std::size_t>(box.to.y() - 1 - cell.y());
    band.values[row * static_cast<std::size_t>(box.size().x()) +
                static_cast<std::size_t>(cell.x() - box.from.x())] = 1.0F;
  }
  raster.bands.push_back(std::move(band));
  std::vector<std::vector<Eigen::Vector2d>> rings;
  for (ContourLine& line : contour_lines(raster, 0.5, 1.0)) rings.push_back(std::move(line.points));
  return rings;
}

}  // namespace

const char* name_of(SurveyedWater::Kind kind) {
  switch (kind) {
    case SurveyedWater::Kind::kSeen:
      return "standing water";
    case SurveyedWater::Kind::kHollow:
      return "hollow";
    case SurveyedWater::Kind::kFlooded:
      return "flooded";
  }
  return "";
}

FloodGround flood_ground(const ColumnGrid& filled, const OccupancyGrid* free_space,
                         double outlet_min_m) {
  const CellBox& box = filled.columns.box();
  FloodGround ground{filled.cell_m, Grid2<float>(box, SurveyColumn::kNone),
                     Grid2<std::uint8_t>(box)};
  for (std::size_t i = 0; i < filled.columns.size(); ++i) {
    if (!is_void_column(filled.columns[i])) continue;
    ground.floor_m[i] = filled.columns[i].floor_m;
    const Eigen::Vector2i cell = filled.columns.cell(i);
    ground.outlets[i] = std::ranges::any_of(kBesideCell, [&](const Eigen::Vector2i& step) {
      return continues(filled, free_space, cell + step);
    });
  }
  remove_narrow(ground.outlets, static_cast<int>(std::ceil(outlet_min_m / filled.cell_m)));
  return ground;
}

std::vector<SurveyedWater> mine_water(const ColumnGrid& columns, const ColumnGrid& filled,
                                      const OccupancyGrid* free_space,
                                      const std::vector<HazardMark>& hazards,
                                      std::optional<double> level_m) {
  std::vector<SurveyedWater> bodies;
  if (filled.columns.size() == 0) return bodies;
  for (const HazardMark& mark : hazards) {
    if (mark.hazard.kind != kWaterHazard) continue;
    if (auto water = standing_water(columns, filled, mark)) bodies.push_back(std::move(*water));
  }
  const FloodGround ground = flood_ground(filled, free_space);
  for (WaterBody& body : hollows(ground))
    bodies.push_back(surveyed(SurveyedWater::Kind::kHollow, std::move(body), ground, filled));
  if (level_m) {
    for (WaterBody& body : flooded_at(ground, *level_m, kFloodedAreaMinM2))
      bodies.push_back(surveyed(SurveyedWater::Kind::kFlooded, std::move(body), ground, filled));
  }
  return bodies;
}

VectorLayer water_layer(const std::vector<SurveyedWater>& bodies, const SurveyFrame& frame,
                        double cell_m) {
  using Type = VectorLayer::Field::Type;
  VectorLayer layer{"water",
                    VectorLayer::Geometry::kLine,
                    {{"water", Type::kInteger},
                     {"kind", Type::kText},
                     {"level_m", Type::kNumber},
                     {"level_sd_m", Type::kNumber},
                     {"area_m2", Type::kNumber},
                     {"volume_m3", Type::kNumber},
                     {"depth_m", Type::kNumber}},
                    {}};
  std::int64_t number = 0;
  for (const SurveyedWater& water : bodies) {
    ++number;
    const double z_m = frame.origin().z() + water.body.level_m;
    for (const auto& ring : rings_of(water.body, frame, cell_m)) {
      VectorFeature feature{
          {},
          {number, std::string(name_of(water.kind)), z_m, water.level_sd_m, water.area_m2.value,
           known(water.volume_m3.value), known(water.depth_m.value)},
          ""};
      for (const Eigen::Vector2d& p : ring) feature.points.emplace_back(p.x(), p.y(), z_m);
      layer.features.push_back(std::move(feature));
    }
  }
  return layer;
}

std::string water_table(const std::vector<SurveyedWater>& bodies, const SurveyFrame& frame) {
  std::string table =
      "water,kind,x_m,y_m,level_m,level_sd_m,area_m2,area_sd_m2,volume_m3,volume_sd_m3,depth_m,"
      "depth_sd_m,spill_level_m,spill_x_m,spill_y_m,spills\n";
  int number = 0;
  for (const SurveyedWater& water : bodies) {
    const WaterBody& body = water.body;
    const Eigen::Vector2d p = frame.in_grid(body.deepest);
    fmt::format_to(std::back_inserter(table), "{},{},{},{},{},{},{},{},{},{},{},{},", ++number,
                   name_of(water.kind), csv(p.x()), csv(p.y()),
                   csv(frame.origin().z() + body.level_m), csv(water.level_sd_m),
                   csv(water.area_m2.value, 2), csv(water.area_m2.sd, 2),
                   csv(water.volume_m3.value), csv(water.volume_m3.sd), csv(water.depth_m.value),
                   csv(water.depth_m.sd));
    if (body.spill) {
      const Eigen::Vector2d place = frame.in_grid(body.spill->place);
      fmt::format_to(std::back_inserter(table), "{},{},{},{}\n",
                     csv(frame.origin().z() + body.spill->level_m), csv(place.x()), csv(place.y()),
                     body.spill->out_of_sight ? "beyond what was seen" : "to lower floor");
    } else {
      table += water.kind == SurveyedWater::Kind::kSeen ? ",,,unknown\n" : ",,,no outlet seen\n";
    }
  }
  return table;
}

}  // namespace adit
