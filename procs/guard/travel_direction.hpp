// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace adit {

/// The direction in which the vehicle has come to where it is: 1 forward, -1 in reverse, 0 as long
/// as it has not moved. A command to reverse does not change it, and neither do the first
/// decimetres of that drive: readings of the ground are late, and the vehicle is still where it
/// came to in the direction before.
class TravelDirection {
 public:
  static constexpr double kReversalM = 0.3;  ///< travelled back, after which the direction is new

  static constexpr double kStandsM_S = 0.01;  ///< measured speed below which the vehicle stands

  /// The measured speed [m/s], ahead positive, at a time in MonotonicTime [µs], which does not
  /// decrease.
  void add(double speed_m_s, std::int64_t at_us);

  [[nodiscard]] int direction() const { return direction_; }

 private:
  int direction_ = 0;
  double back_m_ = 0.0;  ///< travelled against the direction
  std::optional<std::int64_t> at_us_;
};

}  // namespace adit
