// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "tools/cloud/point_cloud.hpp"

namespace adit {

/// A point a line: x, y and z between blanks, commas or semicolons, and any columns behind them.
/// Lines that begin with # or // are comments; the first line may have names of columns. Throws
/// std::runtime_error, with the line, for one that has not three numbers.
PointCloud read_xyz(std::span<const std::uint8_t> bytes);

}  // namespace adit
