// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// A stage that begins asks mapping for all local maps and the graph once more.
struct MapRequest {
  std::int64_t utime = 0;    ///< [µs since the epoch]
  std::string requested_by;  ///< name of the stage

  friend bool operator==(const MapRequest&, const MapRequest&) = default;
};

/// When a stage is to ask mapping for the map: at its start, and again where nothing of it came for
/// a while and something is lacking.
class MapRequestTimer {
 public:
  static constexpr std::int64_t kRetryPeriodUs = 5'000'000;

  /// Something of the map came, or it was asked for.
  void received(std::int64_t utime) { last_utime_ = utime; }

  /// Whether to ask now [µs since the epoch].
  [[nodiscard]] bool is_due(std::int64_t utime, bool map_incomplete) const {
    return map_incomplete && (last_utime_ == 0 || utime - last_utime_ >= kRetryPeriodUs);
  }

 private:
  std::int64_t last_utime_ = 0;
};

}  // namespace adit
