// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace adit {

/// Whether the vehicle is to stand: as soon as there is a reason, and until there was none for a
/// while and a command has come that is newer than the last moment in which there was one. Stands
/// at first.
class StopLatch {
 public:
  explicit StopLatch(double hold_s) : hold_s_(hold_s) {}

  /// Times by MonotonicTime [µs], not before the last; that of the newest command.
  bool evaluate(bool has_reason, std::optional<std::int64_t> command_us, std::int64_t now_us);

 private:
  double hold_s_;
  bool stopped_ = true;
  std::optional<std::int64_t> reason_us_;  ///< when there was a reason last
};

/// Lets the vehicle go back where it came from: what it drove into (bad air, soft ground, a slope)
/// forbids to go on, not to leave. Directions are 1 forward, -1 in reverse, 0 to stand.
class RetreatPermission {
 public:
  /// Something that ended this long ago is over. Before, it may only have wavered at its limit
  /// while the vehicle was leaving, and the way back is still the same.
  static constexpr std::int64_t kClearAfterUs = 10'000'000;

  /// Whether a command in this direction is forbidden, by what is there or not at this time (by
  /// MonotonicTime, not before the last).
  bool forbids(bool is_present, int direction, std::int64_t now_us);

 private:
  int last_direction_ = 0;              ///< direction of the last drive before it was there
  std::optional<int> entry_direction_;  ///< direction in which it was driven into
  std::int64_t last_present_us_ = 0;    ///< when it was there last
};

}  // namespace adit
