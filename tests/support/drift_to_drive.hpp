// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/world/world_description.hpp"

namespace adit {

/// A drift of about 45 m that bends by up to 0.5 rad every few metres, 2.9 to 4.2 m wide between
/// rough walls, with posts, falls of rock and rails. Beside each obstacle at least `lane_m` are
/// left of the drift as planned, to the other side. The same for the same seed.
WorldDescription drift_to_drive(int seed, double lane_m = 2.2);

}  // namespace adit
