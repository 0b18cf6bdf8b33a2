// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "common/grid/grid2.hpp"
#include "tools/survey/frame/registered_cloud.hpp"

namespace adit {

struct ColumnGridParams {
  double cell_m = 0.1;
  double range_max_m = 15.0;     ///< returns from farther away are sparse
  double path_max_m = 12.0;      ///< distance in plan from the path up to which columns are judged
  double middle_m = 0.7;         ///< height over the path at which the space is taken to be open
  double clearance_min_m = 0.4;  ///< a lower gap is no void
  double around_m = 0.4;         ///< around a column, with which its floor and roof are compared
  double step_max_m = 0.2;       ///< between them; a higher step is a wall
  double layer_m = 0.1;          ///< returns this close to the edge of the gap are of its surface
  /// Returns that are sorted at a time, if one row of cells has no more. Does not change the
  /// result.
  std::size_t returns_max = 4'000'000;
};

/// What the 3D scans show of the column of rock and space over a cell.
struct SurveyColumn {
  enum class Kind : std::uint8_t {
    kUnseen,  ///< no return
    kVoid,    ///< space between floor and roof, of which one may be unseen
    kWall,    ///< returns at all heights
  };
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

  Kind kind = Kind::kUnseen;
  float floor_m = kNone;  ///< height in survey
  float roof_m = kNone;
  float floor_sd_m = kNone;  ///< standard deviation of that height in survey
  float roof_sd_m = kNone;
  float plan_sd_m = kNone;  ///< of the place of its returns, in the worst direction

  [[nodiscard]] float height_m() const { return roof_m - floor_m; }
};

/// Floor and roof of the mine by cells of the plan, in survey. Of the space above a cell that gap
/// between returns counts in which a body would be that is as high as the nearest point of the
/// path: where workings lie above each other, those are shown that the robot passed nearest to.
struct ColumnGrid {
  double cell_m = 0.1;
  Grid2<SurveyColumn> columns;
};

/// `path`: places of the body on the ground, in survey. Empty without returns near the path.
ColumnGrid column_grid(const RegisteredCloud& cloud, const std::vector<Eigen::Vector3d>& path,
                       const ColumnGridParams& params = {});

}  // namespace adit
