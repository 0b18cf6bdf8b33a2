// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/sensing/laser_id.hpp"

namespace adit {

/// The robot stands and is to look at what is before it: one tilt sweep of a laser.
struct ScanRequest {
  std::int64_t utime = 0;  ///< time of the request [µs since the epoch]
  std::int32_t id = 0;     ///< that the cloud is to have
  LaserId laser = LaserId::kFront;

  friend bool operator==(const ScanRequest&, const ScanRequest&) = default;
};

}  // namespace adit
