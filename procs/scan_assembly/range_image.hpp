// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// The scans of a tilt sweep as an image: a row for each scan, a column for each beam. Ranges in
/// metres; infinity where nothing came back; NaN where the reading is not to be believed.
using RangeImage = std::vector<std::vector<float>>;

RangeImage range_image(std::span<const LaserScan> scans, const LaserMount& mount);

}  // namespace adit
