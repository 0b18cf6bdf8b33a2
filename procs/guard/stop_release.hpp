// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace adit {

/// Latches the stop: it is set with a reason, and released when there has been no reason for
/// `hold_s` and a drive command is newer than the last reason. Initially set. A stop soon after a
/// release shows that the reason had not gone: each one doubles the time, up to eight times.
class StopLatch {
 public:
  static constexpr double kSoonS = 1.0;
  static constexpr double kHoldFactorMax = 8.0;

  explicit StopLatch(double hold_s) : hold_s_(hold_s) {}

  /// `command_us` is the time of the newest command. Times are in MonotonicTime [µs] and do not
  /// decrease.
  bool evaluate(bool has_reason, std::optional<std::int64_t> command_us, std::int64_t now_us);

 private:
  double hold_s_;
  double hold_factor_ = 1.0;
  bool stopped_ = true;
  std::optional<std::int64_t> released_us_;  ///< time of the last release
  std::optional<std::int64_t> reason_us_;    ///< time of the last reason
};

/// Permits the vehicle to retreat from a hazard that it drove into (bad air, soft ground, a slope):
/// the hazard forbids the direction of entry, not the opposite one. Directions are 1 forward, -1 in
/// reverse, 0 to stand.
class RetreatPermission {
 public:
  /// A hazard is over after this time without it. For a shorter time it may vary around its limit
  /// while the vehicle retreats, and the direction of entry remains.
  static constexpr std::int64_t kClearAfterUs = 10'000'000;

  /// Whether a command in a direction is forbidden, given whether the hazard is present and in
  /// which direction the vehicle came to where it is. `now_us` is in MonotonicTime and does not
  /// decrease.
  bool forbids(bool is_present, int commanded, int travelled, std::int64_t now_us);

 private:
  int last_direction_ = 0;              ///< travelled last without the hazard
  std::optional<int> entry_direction_;  ///< in which the vehicle drove into it
  std::int64_t last_present_us_ = 0;    ///< time of its last presence
};

}  // namespace adit
