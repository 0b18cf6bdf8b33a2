// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/vehicle.hpp"

namespace adit {

/// A vehicle with its corners cut at 45°: its footprint is where |x| and |y| are at most half its
/// length and width, and |x| + |y| at most their sum less `cut_m`.
inline Vehicle chamfered(Vehicle vehicle, double cut_m) {
  const double x = vehicle.length_m / 2.0;
  const double y = vehicle.width_m / 2.0;
  vehicle.footprint.clear();
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-1.0, 1.0}) {
      vehicle.footprint.push_back({end * x, side * (y - cut_m)});
      vehicle.footprint.push_back({end * (x - cut_m), side * y});
    }
  }
  return vehicle;
}

}  // namespace adit
