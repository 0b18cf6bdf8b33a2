// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "common/types/terrain_map.hpp"
#include "procs/terrain/memory/driven_path.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// The ground that the body itself has come over, on a map. Its height is that of the ground which
/// was seen under it or nearby along the way; without any, nothing is said.
class DrivenGround {
 public:
  /// `map` has the heights that are seen or remembered. Places in odom, oldest first, the last one
  /// on the level of the map.
  DrivenGround(const TerrainMap& map, const std::deque<DrivenPath::Place>& places,
               const Vehicle& vehicle);

  /// What carried the wheels is even ground: fills cells that are not known and for which `changed`
  /// is 0. What the belly came over nobody has seen. `observed_at_m` is of each cell how far the
  /// body had come when it was seen: it takes back what the body has since come through, wheels and
  /// all.
  void fill_driven(TerrainMap& map, const std::vector<std::uint8_t>& changed,
                   const std::vector<float>& observed_at_m) const;

 private:
  struct BodyPose {
    Pose2 T_level_body;
    float distance_travelled_m;
    float z_m;  ///< NaN where it is not known
  };
  [[nodiscard]] float seen_height_m(const TerrainMap& map, const Pose2& T_level_body) const;
  void interpolate();

  Vehicle vehicle_;
  std::vector<BodyPose> poses_;  ///< within the map
};

}  // namespace adit
