// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/simulation_params.hpp"

#include <numbers>

namespace adit {

Lasers groundhog_lasers() {
  LaserMount front;
  front.T_body_laser = {1.05, 0.0, 0.0};
  front.height_m = 0.62;
  front.lever_x_m = 0.06;
  front.lever_z_m = 0.08;
  front.range_min_m = 0.2;
  front.range_max_m = 80.0;  // no return reads 81.91 m
  LaserMount rear = front;
  rear.T_body_laser = {-1.05, 0.0, std::numbers::pi};
  return {front, rear};
}

}  // namespace adit
