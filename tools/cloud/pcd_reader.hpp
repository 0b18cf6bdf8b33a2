// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "tools/cloud/point_cloud.hpp"

namespace adit {

/// The points of a PCD file (ascii, binary, binary_compressed): fields x, y and z of any type,
/// other fields passed over, and the place of VIEWPOINT as the sensor's. No more is allocated than
/// the bytes that are there can fill. Throws std::runtime_error, one line with the line or the
/// byte, for anything else.
PointCloud read_pcd(std::span<const std::uint8_t> bytes);

}  // namespace adit
