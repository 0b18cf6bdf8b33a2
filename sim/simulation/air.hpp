// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "common/sensing/ground_and_air.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// The air of a world at a place of its plan. Pockets add up; methane takes the place of oxygen as
/// of all else. There is no carbon monoxide.
GasReading air_at(const World& world, const Eigen::Vector2d& p_world, std::int64_t utime);

}  // namespace adit
