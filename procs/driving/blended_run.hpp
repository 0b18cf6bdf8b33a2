// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procs/driving/path_run.hpp"

namespace adit {

/// The same run as it can be steered: each place, its heading too, is the mean over `blend_m` of
/// the way around, less near the ends, which stay where they are. A jump Δκ of the curvature
/// becomes a ramp of that length, half of it before; in return a bend is cut by κ blend²/24.
PathRun blended(const PathRun& run, double blend_m);

}  // namespace adit
