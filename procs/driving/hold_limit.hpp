// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace adit {

/// Says when a vehicle has been held for so long that this will not end by itself. What holds it
/// may let it go a centimetre and hold it again, and so it is the way that counts.
class HoldLimit {
 public:
  static constexpr double kWayM = 0.05;  ///< that begins the time anew

  explicit HoldLimit(double seconds_max) : seconds_max_(seconds_max) {}

  /// The way so far, on any path, while the vehicle drives or is held.
  void go_on(std::int64_t utime, double way_m, bool held);
  void begin_anew() { since_utime_.reset(); }

  [[nodiscard]] bool is_reached() const { return reached_; }

 private:
  double seconds_max_;
  std::optional<std::int64_t> since_utime_;  ///< when it was held first after the way below
  double way_m_ = 0.0;
  bool reached_ = false;
};

}  // namespace adit
