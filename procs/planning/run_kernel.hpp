// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "procs/planning/footprint.hpp"
#include "procs/planning/heading_set.hpp"

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

}  // namespace adit
