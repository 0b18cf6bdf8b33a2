// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// A stage that begins asks mapping for all local maps and the graph once more.
struct MapRequest {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  std::string asked_by;    ///< name of the stage

  friend bool operator==(const MapRequest&, const MapRequest&) = default;
};

}  // namespace adit
