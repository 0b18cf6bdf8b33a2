// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "procs/planning/c_space/footprint.hpp"
#include "procs/planning/c_space/heading_set.hpp"

namespace adit {

/// A set of cells around a cell, as runs along rows: what a vehicle covers of a grid.
struct RunKernel {
  struct Run {
    int row;    ///< from the cell in the middle
    int first;  ///< column, from the cell in the middle
    int last;   ///< inclusive
  };

  std::vector<Run> runs;
  int cells = 0;
  int reach = 0;  ///< greatest distance of a row or a column from the middle
};

/// The cells within `reach` for which `holds(column, row)`.
RunKernel kernel_of(int reach, const std::function<bool(int, int)>& holds);

/// The cells of which any point may lie under one of the rectangles at one of the poses of the
/// body, from the middle of a cell, or within 1 cm of one.
RunKernel swept_kernel(const std::vector<BodyRectangle>& rectangles,
                       const std::vector<Pose2>& poses, double cell_m);

/// The cells with their middle under one of the rectangles, the body standing on the middle of its
/// cell with a heading of the set.
RunKernel covering_kernel(const std::vector<BodyRectangle>& rectangles, const HeadingSet& headings,
                          int heading, double cell_m);

/// The cells of which any point may lie under one of the rectangles when the body stands anywhere
/// in its cell, with any heading nearer to this one of the set than to its neighbours. It misses
/// none, and has others only within 1 cm.
RunKernel conservative_kernel(const std::vector<BodyRectangle>& rectangles,
                              const HeadingSet& headings, int heading, double cell_m);

/// Sums along the rows of a layer of a grid from the left, so that the sum of a run of cells is one
/// difference, exact in whole numbers. They may run over: a difference is right modulo the range of
/// `Sum`, and what a kernel adds up to fits into it. Around the layer lies a border of one value.
template <class Sum>
class RowSums {
 public:
  /// `value(column, row)` is asked within the layer only.
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

  /// Adds to `totals` the sums of the kernel around each of the cells of a row, as many as there
  /// are totals.
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

  /// The sum of a kernel around one cell.
  [[nodiscard]] Sum around(const RunKernel& kernel, int column, int row) const {
    Sum total = 0;
    for (const RunKernel::Run& run : kernel.runs) {
      total = static_cast<Sum>(total + *at(run.row + row, run.last + 1 + column) -
                               *at(run.row + row, run.first + column));
    }
    return total;
  }

 private:
  /// Sum of the cells of a row left of a column.
  [[nodiscard]] const Sum* at(int row, int column) const {
    return sums_.data() + static_cast<std::size_t>(row + border_) * stride_ +
           static_cast<std::size_t>(column + border_);
  }

  int border_;
  std::size_t stride_;
  std::vector<Sum> sums_;
};

}  // namespace adit
