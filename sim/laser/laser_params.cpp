// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/laser_params.hpp"

#include <numbers>

namespace adit {

double LaserParams::angle_step_rad() const { return std::numbers::pi / (beams - 1); }

}  // namespace adit
