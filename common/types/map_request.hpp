// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// Request to mapping to publish all local maps and the pose graph again.
struct MapRequest {
  std::int64_t utime = 0;    ///< [µs since the epoch]
  std::string requested_by;  ///< name of the stage

  friend bool operator==(const MapRequest&, const MapRequest&) = default;
};

/// Decides when a stage requests the map: at its start, and again if the map is incomplete and
/// nothing of it has been received for a while.
class MapRequestTimer {
 public:
  static constexpr std::int64_t kRetryPeriodUs = 5'000'000;

  /// A part of the map was received, or the map was requested.
  void received(std::int64_t utime) { last_utime_ = utime; }

  /// True if the map must be requested now [µs since the epoch].
  [[nodiscard]] bool is_due(std::int64_t utime, bool map_incomplete) const {
    return map_incomplete && (last_utime_ == 0 || utime - last_utime_ >= kRetryPeriodUs);
  }

 private:
  std::int64_t last_utime_ = 0;
};

}  // namespace adit
