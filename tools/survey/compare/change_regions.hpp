// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "tools/survey/compare/surface_distances.hpp"

namespace adit {

enum class SurfaceKind : std::uint8_t { kFloor, kRoof, kWall };

/// Roof and floor are surfaces inclined by less than 45 degrees.
SurfaceKind kind_of(const Eigen::Vector3d& normal);
const char* name_of(SurfaceKind kind);

/// A connected part of the surface that moved to one side.
struct ChangeRegion {
  SurfaceKind kind = SurfaceKind::kWall;  ///< of most of it
  bool rock_gone = false;                 ///< otherwise the surface moved into the void
  Eigen::Vector3d p{0.0, 0.0, 0.0};       ///< its middle, in comparison [m]
  double area_m2 = 0.0;
  double mean_m = 0.0;  ///< of the distances, signed
  double most_m = 0.0;  ///< the largest one, signed
  double volume_m3 = 0.0;
  double volume_sd_m3 = 0.0;
  std::vector<std::size_t> cores;  ///< positions in the list of distances

  /// What it is most likely, for people.
  [[nodiscard]] const char* meaning() const;
};

struct ChangeRegionParams {
  double reach_m = 0.2;      ///< between neighbours of a region
  double area_min_m2 = 0.2;  ///< of a region; of a smaller one 5 % of unchanged surface has many
  double mean_min_sd = 2.5;  ///< mean distance over the mean standard deviation
};

/// Regions of significant change, the largest volume first. Single significant points are chance:
/// 5 % of what did not change.
std::vector<ChangeRegion> change_regions(const std::vector<SurfaceDistance>& distances,
                                         const ChangeRegionParams& params);

}  // namespace adit
