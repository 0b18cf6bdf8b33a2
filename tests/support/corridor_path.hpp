// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/path/planned_path.hpp"
#include "common/vehicle/vehicle.hpp"

namespace adit {

/// What planning finds through a random corridor, for a robot that stands anywhere between the
/// poses of the lattice; in the frame of that robot.
PlannedPath corridor_path(std::uint32_t seed, const Vehicle& vehicle);

}  // namespace adit
