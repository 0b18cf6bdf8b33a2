// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Parameters of what the viewer shows.
struct SceneParameters {
  double map_cell_m = 0.1;            ///< of /map; larger for a map of more than map_cells_max
  int map_cells_max = 16'000'000;     ///< of /map
  int volume_points_max = 1'000'000;  ///< of /volume
  double volume_cell_m = 0.1;         ///< one point of a 3D scan for each; larger for long missions
  Lasers lasers;                      ///< until a CONFIG states those of the robot
  Vehicle vehicle;

  template <class V>
  void visit(V& v) {
    v("map_cell_m", map_cell_m, within(0.02, 1.0));
    v("map_cells_max", map_cells_max, at_least(10'000));
    v("volume_points_max", volume_points_max, at_least(1000));
    v("volume_cell_m", volume_cell_m, within(0.02, 1.0));
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
  }
};

}  // namespace adit
