// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/raster/column_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "common/geometry/order_statistics.hpp"
#include "common/pose_graph/map_correction.hpp"

namespace adit {
namespace {

/// A return in a column.
struct ColumnReturn {
  std::uint32_t cell = 0;  ///< position in the storage of the grid
  float z_m = 0.0F;
  float z_sd_m = 0.0F;     ///< of what its scan adds
  std::uint32_t node = 0;  ///< of SurveyGraph
};

/// The cells around a path, each with the height of its nearest point.
class PathHeights {
 public:
  PathHeights(const std::vector<Eigen::Vector3d>& path, double cell_m, double distance_max_m)
      : path_(path), cell_m_(cell_m) {
    CellBox box;
    const int margin = static_cast<int>(std::ceil(distance_max_m / cell_m)) + 1;
    for (const Eigen::Vector3d& p : path) {
      const Eigen::Vector2i cell = cell_of(p.head<2>(), cell_m);
      box = united(box, CellBox{cell.array() - margin, cell.array() + margin + 1});
    }
    nearest_ = Grid2<std::int32_t>(box, -1);
    grow(distance_max_m);
  }

  [[nodiscard]] const CellBox& box() const { return nearest_.box(); }
  [[nodiscard]] bool is_near(const Eigen::Vector2i& cell) const {
    return nearest_.get(cell, -1) >= 0;
  }
  /// Position of a cell of box() in the storage of a grid.
  [[nodiscard]] std::size_t index(const Eigen::Vector2i& cell) const {
    return nearest_.index(cell);
  }
  [[nodiscard]] double at(std::size_t cell) const {
    return path_[static_cast<std::size_t>(nearest_[cell])].z();
  }

 private:
  struct Front {
    double distance_m = 0.0;
    std::size_t cell = 0;
    std::int32_t point = 0;
    /// The nearest first; ties by cell and point, so that the order is the same everywhere.
    bool operator<(const Front& other) const {
      if (distance_m != other.distance_m) return distance_m > other.distance_m;
      return std::pair(cell, point) > std::pair(other.cell, other.point);
    }
  };

  /// Each cell takes over the point of a neighbour: nearly always the nearest one.
  void grow(double distance_max_m) {
    std::priority_queue<Front> open;
    const auto push = [&](std::size_t cell, std::int32_t point) {
      const Eigen::Vector2d p = path_[static_cast<std::size_t>(point)].head<2>();
      const double distance_m = (centre_of(nearest_.cell(cell), cell_m_) - p).norm();
      if (distance_m <= distance_max_m) open.push({distance_m, cell, point});
    };
    for (std::size_t i = 0; i < path_.size(); ++i) {
      push(nearest_.index(cell_of(path_[i].head<2>(), cell_m_)), static_cast<std::int32_t>(i));
    }
    const auto around = nearest_.around();
    while (!open.empty()) {
      const Front front = open.top();
      open.pop();
      if (nearest_[front.cell] >= 0) continue;
      nearest_[front.cell] = front.point;
      for (const std::ptrdiff_t step : around) {
        const std::size_t next = front.cell + static_cast<std::size_t>(step);
        if (nearest_[next] < 0) push(next, front.point);
      }
    }
  }

  const std::vector<Eigen::Vector3d>& path_;
  double cell_m_;
  Grid2<std::int32_t> nearest_;  ///< index of the nearest point of the path; −1: too far
};

/// The returns that are judged, by rows of cells, so that those of a few rows can be had at a time:
/// all together would take more memory than the 3D scans.
class ReturnsByRow {
 public:
  /// All must outlive this.
  ReturnsByRow(const RegisteredCloud& cloud, const PathHeights& path,
               const ColumnGridParams& params)
      : cloud_(cloud), path_(path), params_(params), returns_of_row_(rows(), 0) {
    for (const PlacedCloud& scan : cloud.scans()) {
      RowRange seen{rows(), 0};
      for_each_return(scan, [&](const SurveyPoint& /*point*/, const Eigen::Vector2i& cell) {
        const std::size_t row = row_of(cell);
        ++returns_of_row_[row];
        seen = {std::min(seen.begin, row), std::max(seen.end, row + 1)};
      });
      rows_of_scan_.push_back(seen);
    }
  }

  /// Calls `visit` with the returns of the rows, a part of them at a time, each part in ascending
  /// order of cells and then of heights. No cell is in two parts.
  template <class Visit>
  void for_each_part(Visit visit) const {
    for (RowRange part{0, 0}; part.begin < rows(); part.begin = part.end) {
      std::size_t count = 0;
      do {
        count += returns_of_row_[part.end++];
      } while (part.end < rows() && count + returns_of_row_[part.end] <= params_.returns_max);
      if (count > 0) visit(returns_in(part, count));
    }
  }

 private:
  struct RowRange {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  [[nodiscard]] std::size_t rows() const {
    return static_cast<std::size_t>(path_.box().size().y());
  }
  [[nodiscard]] std::size_t row_of(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y() - path_.box().from.y());
  }

  template <class Visit>
  void for_each_return(const PlacedCloud& scan, Visit visit) const {
    const Eigen::Vector2d origin = scan.T_survey_level.translation().head<2>();
    const auto judge = [&](const SurveyPoint& point) {
      const Eigen::Vector2d p = point.p_survey.head<2>();
      const Eigen::Vector2i cell = cell_of(p, params_.cell_m);
      if (path_.is_near(cell) && (p - origin).norm() <= params_.range_max_m) visit(point, cell);
    };
    cloud_.for_each_point_of(scan, judge);
  }

  [[nodiscard]] std::vector<ColumnReturn> returns_in(const RowRange& part,
                                                     std::size_t count) const {
    std::vector<ColumnReturn> returns;
    returns.reserve(count);
    for (std::size_t i = 0; i < rows_of_scan_.size(); ++i) {
      if (rows_of_scan_[i].end <= part.begin || rows_of_scan_[i].begin >= part.end) continue;
      for_each_return(
          cloud_.scans()[i], [&](const SurveyPoint& point, const Eigen::Vector2i& cell) {
            const std::size_t row = row_of(cell);
            if (row < part.begin || row >= part.end) return;
            returns.push_back({static_cast<std::uint32_t>(path_.index(cell)),
                               static_cast<float>(point.p_survey.z()),
                               static_cast<float>(std::sqrt(cloud_.scan_covariance(point)(2, 2))),
                               static_cast<std::uint32_t>(point.scan->node)});
          });
    }
    std::ranges::sort(returns, [](const ColumnReturn& a, const ColumnReturn& b) {
      return std::tie(a.cell, a.z_m, a.node) < std::tie(b.cell, b.z_m, b.node);
    });
    return returns;
  }

  const RegisteredCloud& cloud_;
  const PathHeights& path_;
  const ColumnGridParams& params_;
  std::vector<std::size_t> returns_of_row_;
  std::vector<RowRange> rows_of_scan_;
};

using Returns = std::span<const ColumnReturn>;

/// Height of a surface from the returns of its layer: their median. Its standard deviation has the
/// error of a scan, which its returns share, and the scatter of their mean.
struct Surface {
  float z_m = SurveyColumn::kNone;
  double scan_sd_m = 0.0;
  std::size_t node = 0;
};

Surface surface_of(Returns layer) {
  if (layer.empty()) return {};
  const ColumnReturn& middle = layer[layer.size() / 2];
  double square = 0.0;
  double scan_sd_m = layer.front().z_sd_m;
  for (const ColumnReturn& at : layer) {
    square += std::pow(static_cast<double>(at.z_m - middle.z_m), 2);
    scan_sd_m = std::min(scan_sd_m, static_cast<double>(at.z_sd_m));
  }
  const double scatter_m = std::sqrt(square) / static_cast<double>(layer.size());
  return {middle.z_m, std::hypot(scan_sd_m, scatter_m), middle.node};
}

float z_sd_m(const Surface& surface, const SurveyGraph& graph) {
  if (!std::isfinite(surface.z_m)) return SurveyColumn::kNone;
  const double z_variance = graph.nodes()[surface.node].z_variance;
  return static_cast<float>(std::sqrt(z_variance + surface.scan_sd_m * surface.scan_sd_m));
}

/// `returns` in ascending order of heights; `z_middle_m`: where the space is taken to be open.
SurveyColumn column_of(Returns returns, const Eigen::Vector2d& p_survey, double z_middle_m,
                       const SurveyGraph& graph, const ColumnGridParams& params) {
  const auto above = static_cast<std::size_t>(
      std::ranges::partition_point(returns,
                                   [&](const ColumnReturn& at) { return at.z_m < z_middle_m; }) -
      returns.begin());
  const Returns below = returns.first(above);
  const Returns beyond = returns.subspan(above);
  SurveyColumn column;
  column.kind = SurveyColumn::Kind::kWall;
  const Eigen::Vector3d p(p_survey.x(), p_survey.y(), z_middle_m);
  column.plan_sd_m =
      static_cast<float>(position_sd_m(graph.covariance_at(returns[returns.size() / 2].node, p)));
  if (!below.empty() && !beyond.empty() &&
      beyond.front().z_m - below.back().z_m < params.clearance_min_m)
    return column;

  const auto layer = static_cast<float>(params.layer_m);
  const auto floor_begin = std::ranges::partition_point(
      below, [&](const ColumnReturn& at) { return at.z_m < below.back().z_m - layer; });
  const auto roof_end = std::ranges::partition_point(
      beyond, [&](const ColumnReturn& at) { return at.z_m <= beyond.front().z_m + layer; });
  const Surface floor = surface_of({floor_begin, below.end()});
  const Surface roof = surface_of({beyond.begin(), roof_end});
  column.kind = SurveyColumn::Kind::kVoid;
  column.floor_m = floor.z_m;
  column.roof_m = roof.z_m;
  column.floor_sd_m = z_sd_m(floor, graph);
  column.roof_sd_m = z_sd_m(roof, graph);
  return column;
}

/// Few returns of a wall look like a high floor or a low roof: columns whose floor is above that of
/// the columns around them, or whose roof is below theirs, are wall.
void tell_walls(const ColumnGridParams& params, Grid2<SurveyColumn>& columns) {
  const Grid2<SurveyColumn> before = columns;
  const int reach = static_cast<int>(std::round(params.around_m / params.cell_m));
  std::vector<double> floors;
  std::vector<double> roofs;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].kind != SurveyColumn::Kind::kVoid) continue;
    floors.clear();
    roofs.clear();
    const Eigen::Vector2i cell = before.cell(i);
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        const SurveyColumn& beside = before.get(cell + Eigen::Vector2i(x, y));
        if (std::isfinite(beside.floor_m)) floors.push_back(beside.floor_m);
        if (std::isfinite(beside.roof_m)) roofs.push_back(beside.roof_m);
      }
    }
    if (before[i].floor_m > median(floors) + params.step_max_m ||
        before[i].roof_m < median(roofs) - params.step_max_m) {
      columns[i] = SurveyColumn{};
      columns[i].kind = SurveyColumn::Kind::kWall;
      columns[i].plan_sd_m = before[i].plan_sd_m;
    }
  }
}

/// The smallest box around all columns with returns.
CellBox seen_box(const Grid2<SurveyColumn>& columns) {
  CellBox box;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].kind != SurveyColumn::Kind::kUnseen) box = united(box, columns.cell(i));
  }
  return box;
}

Grid2<SurveyColumn> cropped(const Grid2<SurveyColumn>& columns, const CellBox& box) {
  Grid2<SurveyColumn> part(box);
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = columns.at(part.cell(i));
  return part;
}

}  // namespace

ColumnGrid column_grid(const RegisteredCloud& cloud, const std::vector<Eigen::Vector3d>& path,
                       const ColumnGridParams& params) {
  if (path.empty()) return {params.cell_m, {}};
  const PathHeights heights(path, params.cell_m, params.path_max_m);
  Grid2<SurveyColumn> columns(heights.box());
  ReturnsByRow(cloud, heights, params).for_each_part([&](const std::vector<ColumnReturn>& returns) {
    const auto end = returns.end();
    for (auto first = returns.begin(); first != end;) {
      const std::uint32_t cell = first->cell;
      const auto last =
          std::find_if(first, end, [&](const ColumnReturn& at) { return at.cell != cell; });
      columns[cell] = column_of({first, last}, centre_of(columns.cell(cell), params.cell_m),
                                heights.at(cell) + params.middle_m, cloud.graph(), params);
      first = last;
    }
  });
  columns = cropped(columns, seen_box(columns));
  tell_walls(params, columns);
  return {params.cell_m, std::move(columns)};
}

}  // namespace adit
