// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/plan_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace adit {
namespace {

// Fraction of a grid edge: minimum distance of a wall crossing from the edge's ends.
constexpr double kEdgeShareMin = 0.01;
// Fraction of a grid edge: minimum length of a wall segment.
constexpr double kWallShareMin = 0.1;
// Limits on the grid squares around tunnels and rooms, and in total; more would take longer than a
// few seconds.
constexpr std::int64_t kNearSquaresMax = 10'000'000;
constexpr std::int64_t kSquaresMax = 2'000'000'000;

/// One row of grid corners: depths, and the points created from them.
struct NodeRow {
  explicit NodeRow(std::size_t nodes) : depth(nodes), node(nodes), crossing(nodes) {}

  void clear() {
    std::fill(depth.begin(), depth.end(), -1.0);
    std::fill(node.begin(), node.end(), PlanMesh::kNone);
    std::fill(crossing.begin(), crossing.end(), PlanMesh::kNone);
  }

  std::vector<double> depth;
  std::vector<std::uint32_t> node;
  std::vector<std::uint32_t> crossing;  ///< on the edge to the next corner of the row
};

/// A corner of a grid square, or an edge by its first corner, counter-clockwise from the lower
/// left.
constexpr std::array<std::array<int, 2>, 4> kSquareCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

void require_reasonable_size(const PlanBuckets& buckets, double grid_m) {
  std::int64_t near = 0;
  for (int row = 0; row < buckets.rows(); ++row) {
    for (int column = 0; column < buckets.columns(); ++column) {
      if (!buckets.at(column, row).empty()) ++near;
    }
  }
  const std::int64_t side = std::lround(buckets.side_m() / grid_m);
  const std::int64_t in_bucket = side * side;
  const std::int64_t all = std::int64_t{buckets.rows()} * buckets.columns();
  if (near * in_bucket <= kNearSquaresMax && all * in_bucket <= kSquaresMax) return;
  throw std::invalid_argument(fmt::format(
      "the plan is too large for edges of {:f} m: reduce it, or increase grid_m", grid_m));
}

/// Processes the grid row by row, with two rows in memory.
class PlanMesher {
 public:
  PlanMesher(const OpenSpace& space, double grid_m)
      : space_(space),
        grid_m_(grid_m),
        cells_per_bucket_(static_cast<int>(std::lround(space.buckets().side_m() / grid_m))),
        columns_(space.buckets().columns() * cells_per_bucket_),
        rows_{NodeRow(nodes()), NodeRow(nodes())},
        upright_(nodes()) {}

  PlanMesh mesh() {
    for (NodeRow& row : rows_) row.clear();
    for (int row = 0; row < space_.buckets().rows() * cells_per_bucket_; ++row) add_row(row);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::size_t nodes() const { return static_cast<std::size_t>(columns_) + 1; }

  [[nodiscard]] Eigen::Vector2d place(int column, int row) const {
    return space_.buckets().origin() + grid_m_ * Eigen::Vector2d(column, row);
  }

  void add_row(int row) {
    row_ = row;
    std::swap(rows_[0], rows_[1]);
    rows_[1].clear();
    std::fill(upright_.begin(), upright_.end(), PlanMesh::kNone);
    const int bucket_row = row / cells_per_bucket_;
    for (int bucket = 0; bucket < space_.buckets().columns(); ++bucket) {
      if (space_.buckets().at(bucket, bucket_row).empty()) continue;
      const int first = bucket * cells_per_bucket_;
      for (int i = 0; i <= cells_per_bucket_; ++i) {
        const int column = first + i;
        rows_[1].depth[static_cast<std::size_t>(column)] = space_.depth_m(place(column, row + 1));
      }
      for (int i = 0; i < cells_per_bucket_; ++i) add_cell(first + i);
    }
  }

  void add_cell(int column) {
    column_ = column;
    int open = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      depth_[i] = row_of(i).depth[column_of(i)];
      open += is_open(i) ? 1 : 0;
    }
    if (open == 0) return;
    const bool across = open == 2 && is_open(0) == is_open(2);
    if (across && depth_[0] + depth_[1] + depth_[2] + depth_[3] <= 0.0) {
      add_corners_apart();
    } else {
      add_polygon();
    }
  }

  /// Each open corner of the square as a triangle.
  void add_corners_apart() {
    for (std::size_t i = 0; i < 4; ++i) {
      if (!is_open(i)) continue;
      const std::uint32_t leaves = crossing(i);
      const std::uint32_t enters = crossing((i + 3) % 4);
      mesh_.triangles.push_back({node(i), leaves, enters});
      mesh_.next_on_wall[leaves] = enters;
    }
  }

  /// The open part of the square as one polygon.
  void add_polygon() {
    std::size_t start = 0;
    while (!is_open(start)) ++start;
    polygon_.clear();
    std::uint32_t leaves = PlanMesh::kNone;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t i = (start + k) % 4;
      if (is_open(i)) polygon_.push_back(node(i));
      if (is_open(i) == is_open((i + 1) % 4)) continue;
      polygon_.push_back(crossing(i));
      if (is_open(i)) {
        leaves = polygon_.back();
      } else {
        mesh_.next_on_wall[leaves] = polygon_.back();
      }
    }
    for (std::size_t i = 2; i < polygon_.size(); ++i) {
      mesh_.triangles.push_back({polygon_[0], polygon_[i - 1], polygon_[i]});
    }
  }

  [[nodiscard]] bool is_open(std::size_t corner) const { return depth_[corner] > 0.0; }
  [[nodiscard]] std::size_t column_of(std::size_t corner) const {
    const int column = column_ + kSquareCorners[corner][0];
    return static_cast<std::size_t>(column);
  }
  NodeRow& row_of(std::size_t corner) {
    return rows_[static_cast<std::size_t>(kSquareCorners[corner][1])];
  }
  [[nodiscard]] Eigen::Vector2d place(std::size_t corner) const {
    return place(column_ + kSquareCorners[corner][0], row_ + kSquareCorners[corner][1]);
  }

  std::uint32_t add_point(const Eigen::Vector2d& p_world) {
    mesh_.points.push_back(p_world);
    mesh_.next_on_wall.push_back(PlanMesh::kNone);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }

  std::uint32_t node(std::size_t corner) {
    std::uint32_t& index = row_of(corner).node[column_of(corner)];
    if (index == PlanMesh::kNone) index = add_point(place(corner));
    return index;
  }

  /// Where the wall crosses the edge that begins at a corner.
  std::uint32_t crossing(std::size_t edge) {
    const std::size_t end = (edge + 1) % 4;
    std::uint32_t& index = edge == 1   ? upright_[column_of(1)]
                           : edge == 3 ? upright_[column_of(0)]
                           : edge == 0 ? rows_[0].crossing[column_of(0)]
                                       : rows_[1].crossing[column_of(3)];
    if (index == PlanMesh::kNone) {
      const double share = std::clamp(depth_[edge] / (depth_[edge] - depth_[end]), kEdgeShareMin,
                                      1.0 - kEdgeShareMin);
      index = add_point(place(edge) + share * (place(end) - place(edge)));
    }
    return index;
  }

  const OpenSpace& space_;
  double grid_m_;
  int cells_per_bucket_;
  int columns_;
  std::array<NodeRow, 2> rows_;         ///< below and above the squares at hand
  std::vector<std::uint32_t> upright_;  ///< crossings of the edges between these rows
  int row_ = 0;                         ///< of the square at hand
  int column_ = 0;
  std::array<double, 4> depth_{};  ///< at its corners
  std::vector<std::uint32_t> polygon_;
  PlanMesh mesh_;
};

using Indices = std::vector<std::uint32_t>;

/// Merges points; indices are those of the points before the merge.
class WallMerger {
 public:
  WallMerger(PlanMesh& mesh, double shortest_m)
      : mesh_(mesh), shortest_m_(shortest_m), goes_into_(mesh.points.size()) {
    std::iota(goes_into_.begin(), goes_into_.end(), 0U);
  }

  void run() {
    std::vector<bool> done(mesh_.points.size(), false);
    for (std::uint32_t start = 0; start < done.size(); ++start) {
      if (!mesh_.is_on_wall(start) || done[start]) continue;
      const std::size_t count = mark_wall(start, done);
      merge_along(end_of_long_step(start, count), count);
    }
    remove_merged();
  }

 private:
  /// Counts its points.
  std::size_t mark_wall(std::uint32_t start, std::vector<bool>& done) const {
    std::size_t count = 0;
    for (std::uint32_t i = start; !done[i]; i = mesh_.next_on_wall[i]) {
      done[i] = true;
      ++count;
    }
    return count;
  }

  /// A start such that the traversal of the wall ends with a segment that is kept.
  [[nodiscard]] std::uint32_t end_of_long_step(std::uint32_t start, std::size_t count) const {
    std::uint32_t i = start;
    for (std::size_t k = 0; k < count && is_short(i); ++k) i = mesh_.next_on_wall[i];
    return mesh_.next_on_wall[i];
  }

  /// Whether the next point of the wall is too close.
  [[nodiscard]] bool is_short(std::uint32_t i) const {
    return (mesh_.points[mesh_.next_on_wall[i]] - mesh_.points[i]).norm() < shortest_m_;
  }

  void merge_along(std::uint32_t start, std::size_t count) {
    std::uint32_t i = start;
    do {
      const std::uint32_t j = mesh_.next_on_wall[i];
      if (j == start || count <= 3 || !is_short(i)) {
        i = j;
        continue;
      }
      mesh_.points[i] = (mesh_.points[i] + mesh_.points[j]) / 2.0;
      mesh_.next_on_wall[i] = mesh_.next_on_wall[j];
      goes_into_[j] = i;
      --count;
    } while (i != start);
  }

  void remove_merged() {
    Indices index(mesh_.points.size());
    PlanMesh kept;
    for (std::uint32_t i = 0; i < index.size(); ++i) {
      index[i] = static_cast<std::uint32_t>(kept.points.size());
      if (goes_into_[i] != i) continue;
      kept.points.push_back(mesh_.points[i]);
      kept.next_on_wall.push_back(mesh_.next_on_wall[i]);
    }
    const auto renamed = [&](std::uint32_t i) { return index[goes_into_[i]]; };
    for (std::uint32_t& next : kept.next_on_wall) {
      if (next != PlanMesh::kNone) next = renamed(next);
    }
    for (const auto& [a, b, c] : mesh_.triangles) {
      const std::array<std::uint32_t, 3> triangle{renamed(a), renamed(b), renamed(c)};
      const bool flat =
          triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
      if (!flat) kept.triangles.push_back(triangle);
    }
    mesh_ = std::move(kept);
  }

  PlanMesh& mesh_;
  double shortest_m_;
  Indices goes_into_;  ///< for each point, itself or its predecessor on the wall
};

}  // namespace

PlanMesh plan_mesh(const OpenSpace& space, double grid_m) {
  require_reasonable_size(space.buckets(), grid_m);
  PlanMesh mesh = PlanMesher(space, grid_m).mesh();
  merge_short_walls(mesh, kWallShareMin * grid_m);
  return mesh;
}

void merge_short_walls(PlanMesh& mesh, double shortest_m) { WallMerger(mesh, shortest_m).run(); }

}  // namespace adit
