// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "common/geometry/convex_polygon.hpp"
#include "procs/planning/c_space/heading_set.hpp"

namespace adit {

/// A binary convolution kernel, stored as runs of cells along rows: the cells of a grid that a
/// vehicle covers. Rows and columns are relative to the centre cell.
struct RunKernel {
  struct Run {
    int row;
    int first;  ///< first column
    int last;   ///< last column, inclusive
  };

  std::vector<Run> runs;
  int cells = 0;
  int reach = 0;  ///< maximum absolute row or column
};

/// The kernel of the cells within `reach` for which `holds(column, row)` is true.
RunKernel kernel_of(int reach, const std::function<bool(int, int)>& holds);

/// The cells that any of the polygons touches at any of the poses, grown by 1 cm. Poses are
/// relative to the centre of the centre cell.
RunKernel swept_kernel(const std::vector<ConvexPolygon>& polygons, const std::vector<Pose2>& poses,
                       double cell_m);

/// The cells whose centre is inside one of the polygons, with the body at the centre of its cell
/// and exactly at a heading of the set.
RunKernel covering_kernel(const std::vector<ConvexPolygon>& polygons, const HeadingSet& headings,
                          int heading, double cell_m);

/// The cells that one of the polygons may touch with the body anywhere in its cell and at any
/// angle that is nearest to this heading of the set. The kernel is complete, and exceeds the exact
/// set by at most 1 cm.
RunKernel conservative_kernel(const std::vector<ConvexPolygon>& polygons,
                              const HeadingSet& headings, int heading, double cell_m);

/// Prefix sums along the rows of a grid layer: the sum over a run of cells is one difference.
/// Arithmetic is exact and modulo the range of `Sum`: prefix sums may overflow, as long as the sum
/// over a kernel fits. The layer is surrounded by a border of one constant value.
template <class Sum>
class RowSums {
 public:
  /// `value(column, row)` is called for cells of the layer only; the border has the value
  /// `outside` and is `border` cells wide.
  template <class Value>
  RowSums(int columns, int rows, int border, Sum outside, const Value& value)
      : border_(border), stride_(static_cast<std::size_t>(columns + 2 * border) + 1) {
    sums_.resize(stride_ * static_cast<std::size_t>(rows + 2 * border));
    Sum* sum = sums_.data();
    for (int row = -border; row < rows + border; ++row) {
      *sum++ = 0;
      for (int column = -border; column < columns + border; ++column, ++sum) {
        const bool inside = row >= 0 && row < rows && column >= 0 && column < columns;
        *sum =
            static_cast<Sum>(sum[-1] + (inside ? static_cast<Sum>(value(column, row)) : outside));
      }
    }
  }

  /// Adds to `totals[i]` the sum over the kernel centred at column i of a row.
  void add_row(const RunKernel& kernel, int row, std::vector<Sum>& totals) const {
    for (const RunKernel::Run& run : kernel.runs) {
      const Sum* before = at(run.row + row, run.first);
      const Sum* behind = at(run.row + row, run.last + 1);
      Sum* total = totals.data();
      for (std::size_t i = 0; i < totals.size(); ++i) {
        total[i] = static_cast<Sum>(total[i] + behind[i] - before[i]);
      }
    }
  }

  /// The sum over the kernel centred at one cell.
  [[nodiscard]] Sum around(const RunKernel& kernel, int column, int row) const {
    Sum total = 0;
    for (const RunKernel::Run& run : kernel.runs) {
      total = static_cast<Sum>(total + *at(run.row + row, run.last + 1 + column) -
                               *at(run.row + row, run.first + column));
    }
    return total;
  }

 private:
  /// Sum over the cells of a row to the left of a column.
  [[nodiscard]] const Sum* at(int row, int column) const {
    return sums_.data() + static_cast<std::size_t>(row + border_) * stride_ +
           static_cast<std::size_t>(column + border_);
  }

  int border_;
  std::size_t stride_;
  std::vector<Sum> sums_;
};

}  // namespace adit
