// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/convex_polygon.hpp"
#include "common/types/terrain_map.hpp"
#include "procs/terrain/memory/driven_path.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// The ground that the body has driven over, on a map. Its height under the middle of the body is
/// that of the ground observed under the body or near it along the path; where there is none,
/// nothing is filled in. From the middle to the wheels it follows the grade of the observed ground
/// around the body.
class DrivenGround {
 public:
  /// `map` has the observed and recalled heights. Places in odom, oldest first; the last one is on
  /// the level of the map.
  DrivenGround(const TerrainMap& map, const std::vector<DrivenPath::Place>& places,
               const Vehicle& vehicle);

  /// Fills unknown cells that carried the wheels as ground without obstacles, unless `changed` is
  /// set; cells under the belly remain unknown. `observed_at_m`: distance travelled when each cell
  /// was observed; obstacles observed before the body drove through them are removed.
  void fill_driven(TerrainMap& map, const std::vector<std::uint8_t>& changed,
                   const std::vector<float>& observed_at_m) const;

 private:
  struct BodyPose {
    Pose2 T_level_body;
    float distance_travelled_m;
    float z_m;  ///< NaN if unknown
  };
  [[nodiscard]] float observed_height_m(const TerrainMap& map, const Pose2& T_level_body) const;
  [[nodiscard]] Eigen::Vector2f grade_around(const TerrainMap& map, const BodyPose& pose) const;
  /// Fills the unknown cells among those that a wheel touches.
  void fill_wheels(TerrainMap& map, const std::vector<std::uint8_t>& changed,
                   const BodyPose& pose) const;
  void interpolate();

  Vehicle vehicle_;
  ConvexPolygon outline_;              ///< in the body frame, as the wheels
  std::vector<ConvexPolygon> wheels_;  ///< where they touch the ground
  std::vector<BodyPose> poses_;        ///< one per place
};

}  // namespace adit
