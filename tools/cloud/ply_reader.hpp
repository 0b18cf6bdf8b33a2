// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "tools/cloud/point_cloud.hpp"

namespace adit {

/// The vertices of a PLY file (ascii, binary of either byte order): x, y and z of any type;
/// everything else in it is passed over. No more is allocated than the bytes that are there can
/// fill. Throws std::runtime_error, one line with the line or the byte, for anything else.
PointCloud read_ply(std::span<const std::uint8_t> bytes);

}  // namespace adit
