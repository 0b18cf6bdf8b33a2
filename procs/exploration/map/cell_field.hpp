// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "common/grid/occupancy_grid.hpp"

namespace adit {

/// A value for each cell of a box, row by row from the lowest.
template <class T>
class CellField {
 public:
  CellField() = default;
  explicit CellField(const CellBox& box, T value = T{})
      : box_(box), columns_(box.size().x()), cells_(count(box), value) {}

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] std::size_t index(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y() - box_.from.y()) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.x() - box_.from.x());
  }
  [[nodiscard]] Eigen::Vector2i cell(std::size_t index) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return box_.from +
           Eigen::Vector2i(static_cast<int>(index % columns), static_cast<int>(index / columns));
  }
  /// A value that is given for what lies outside.
  [[nodiscard]] T get(const Eigen::Vector2i& cell, T outside = T{}) const {
    return box_.contains(cell) ? cells_[index(cell)] : outside;
  }

  [[nodiscard]] T& operator[](std::size_t index) { return cells_[index]; }
  [[nodiscard]] const T& operator[](std::size_t index) const { return cells_[index]; }

  /// From a cell to the eight around it, counter-clockwise from x; not for cells of the rim.
  [[nodiscard]] std::array<std::ptrdiff_t, 8> around() const {
    const std::ptrdiff_t row = columns_;
    return {1, row + 1, row, row - 1, -1, -row - 1, -row, -row + 1};
  }

  /// The same values in a box that contains this one.
  [[nodiscard]] CellField grown_to(const CellBox& box) const {
    CellField grown(box);
    for (std::size_t i = 0; i < cells_.size(); ++i) grown[grown.index(cell(i))] = cells_[i];
    return grown;
  }

 private:
  static std::size_t count(const CellBox& box) {
    return box.empty() ? 0
                       : static_cast<std::size_t>(box.size().x()) *
                             static_cast<std::size_t>(box.size().y());
  }

  CellBox box_;
  int columns_ = 0;
  std::vector<T> cells_;
};

inline Eigen::Vector2i cell_of(const Eigen::Vector2d& p, double resolution_m) {
  return {static_cast<int>(std::floor(p.x() / resolution_m)),
          static_cast<int>(std::floor(p.y() / resolution_m))};
}

inline Eigen::Vector2d middle_of(const Eigen::Vector2i& cell, double resolution_m) {
  return resolution_m * (cell.cast<double>() + Eigen::Vector2d(0.5, 0.5));
}

}  // namespace adit
