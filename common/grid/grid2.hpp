// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// Cells by integer coordinates: cell (i, j) covers [i, i + 1) × [j, j + 1) times the resolution of
/// the grid, in the frame of the grid. Half open: `from` is included, `to` is not.
struct CellBox {
  Eigen::Vector2i from{0, 0};
  Eigen::Vector2i to{0, 0};

  /// Columns and rows.
  [[nodiscard]] Eigen::Vector2i size() const { return to - from; }
  [[nodiscard]] bool empty() const { return (size().array() <= 0).any(); }
  /// Number of cells.
  [[nodiscard]] std::size_t count() const {
    return empty() ? 0
                   : static_cast<std::size_t>(size().x()) * static_cast<std::size_t>(size().y());
  }
  [[nodiscard]] bool contains(const Eigen::Vector2i& cell) const {
    return (cell.array() >= from.array()).all() && (cell.array() < to.array()).all();
  }
  [[nodiscard]] bool contains(const CellBox& other) const {
    return (other.from.array() >= from.array()).all() && (other.to.array() <= to.array()).all();
  }

  friend bool operator==(const CellBox& a, const CellBox& b) {
    return a.from == b.from && a.to == b.to;
  }
};

/// The smallest box around both.
inline CellBox united(const CellBox& a, const CellBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {a.from.cwiseMin(b.from), a.to.cwiseMax(b.to)};
}

/// The smallest box around a box and a cell.
inline CellBox united(const CellBox& box, const Eigen::Vector2i& cell) {
  return united(box, CellBox{cell, cell + Eigen::Vector2i(1, 1)});
}

/// A value for each cell of a box, stored row by row from the lowest row. The common storage of all
/// planar grids: occupancy, terrain, C-space and the layers of exploration.
template <class T>
class Grid2 {
 public:
  Grid2() = default;
  /// All cells hold `value`. An empty box has no cells.
  explicit Grid2(const CellBox& box, T value = T{})
      : box_(box), columns_(box.size().x()), cells_(box.count(), value) {}
  /// Cells (0, 0) to (columns − 1, rows − 1).
  Grid2(int columns, int rows, T value = T{}) : Grid2(CellBox{{0, 0}, {columns, rows}}, value) {}

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return box_.size().y(); }
  /// Number of cells.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] bool contains(const Eigen::Vector2i& cell) const { return box_.contains(cell); }

  /// Position of a cell of the box in the storage; unchecked.
  [[nodiscard]] std::size_t index(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y() - box_.from.y()) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.x() - box_.from.x());
  }
  /// The cell at a position of the storage.
  [[nodiscard]] Eigen::Vector2i cell(std::size_t index) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return box_.from +
           Eigen::Vector2i(static_cast<int>(index % columns), static_cast<int>(index / columns));
  }

  /// The value of a cell, `outside` for a cell that is not in the box.
  [[nodiscard]] T get(const Eigen::Vector2i& cell, T outside = T{}) const {
    return box_.contains(cell) ? cells_[index(cell)] : outside;
  }
  [[nodiscard]] T& at(const Eigen::Vector2i& cell) { return cells_[index(cell)]; }
  [[nodiscard]] const T& at(const Eigen::Vector2i& cell) const { return cells_[index(cell)]; }
  [[nodiscard]] T& operator[](std::size_t index) { return cells_[index]; }
  [[nodiscard]] const T& operator[](std::size_t index) const { return cells_[index]; }
  /// The values in the order of the storage.
  [[nodiscard]] auto begin() { return cells_.begin(); }
  [[nodiscard]] auto begin() const { return cells_.begin(); }
  [[nodiscard]] auto end() { return cells_.end(); }
  [[nodiscard]] auto end() const { return cells_.end(); }

  /// Offsets in the storage from a cell to its eight neighbours, counter-clockwise from +x. Not
  /// valid for cells on the rim of the box.
  [[nodiscard]] std::array<std::ptrdiff_t, 8> around() const {
    const std::ptrdiff_t row = columns_;
    return {1, row + 1, row, row - 1, -1, -row - 1, -row, -row + 1};
  }

  /// The same values in a box that contains this one; new cells hold T{}.
  [[nodiscard]] Grid2 grown_to(const CellBox& box) const {
    Grid2 grown(box);
    if (cells_.empty()) return grown;
    for (int y = box_.from.y(); y < box_.to.y(); ++y) {
      const Eigen::Vector2i first(box_.from.x(), y);
      std::copy_n(cells_.begin() + static_cast<std::ptrdiff_t>(index(first)), columns_,
                  grown.cells_.begin() + static_cast<std::ptrdiff_t>(grown.index(first)));
    }
    return grown;
  }

 private:
  CellBox box_;
  int columns_ = 0;
  std::vector<T> cells_;
};

/// The cell that contains a point [m].
inline Eigen::Vector2i cell_of(const Eigen::Vector2d& p, double resolution_m) {
  return {static_cast<int>(std::floor(p.x() / resolution_m)),
          static_cast<int>(std::floor(p.y() / resolution_m))};
}

/// The centre of a cell [m].
inline Eigen::Vector2d centre_of(const Eigen::Vector2i& cell, double resolution_m) {
  return resolution_m * (cell.cast<double>() + Eigen::Vector2d(0.5, 0.5));
}

}  // namespace adit
