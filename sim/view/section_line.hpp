// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/view/view_options.hpp"
#include "sim/world/drift_line.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// The line along which a mine is cut: that of the options; where they name none, the drift at the
/// start, over all its edges that follow each other; in a world that knows no drifts, straight
/// ahead through the start from wall to wall. Its name is for people.
DriftLine section_line(const Site& site, const ViewOptions& options);

}  // namespace adit
