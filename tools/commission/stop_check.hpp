// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/types/vehicle_state.hpp"
#include "tools/check_driver/check_result.hpp"

namespace adit {

/// What a person does to a robot that drives slowly, its wheels in the air.
struct StopCause {
  std::string name;    ///< obstacle, laser, operator, supervisor or guard
  std::string action;  ///< for the person, an imperative sentence
  std::string
      reason;  ///< in the STOP of the guard; empty: the time is measured from another message
};

const std::vector<StopCause>& stop_causes();

/// Measures how long the wheels turn on after a cause to stop. Times are those of reception [µs].
/// The time begins
/// - obstacle, laser, supervisor: with the first STOP that states this reason;
/// - operator: with the last command other than to stand;
/// - guard: with its last message, as it sends no more;
/// and ends when VEHICLE_STATE reports standstill.
class StopCheck {
 public:
  static constexpr double kStopMaxS = 0.5;

  /// `cause` is one of stop_causes().
  explicit StopCheck(const StopCause& cause) : cause_(cause) {}

  void add(const VehicleState& state, std::int64_t utime);
  void add(const StopOrder& order, std::int64_t utime);
  void add(const DriveCommand& command, std::int64_t utime);

  /// Whether the wheels have turned: the person may act.
  [[nodiscard]] bool has_moved() const { return moved_utime_.has_value(); }
  /// Whether the wheels stand after they turned.
  [[nodiscard]] bool has_stopped() const { return stopped_utime_.has_value(); }
  /// Pass or fail, as of now.
  [[nodiscard]] CheckResult result() const;

 private:
  [[nodiscard]] std::optional<std::int64_t> cause_utime() const;

  StopCause cause_;
  std::optional<std::int64_t> moved_utime_;
  std::optional<std::int64_t> stopped_utime_;
  std::optional<std::int64_t> reason_utime_;
  std::optional<std::int64_t> last_command_utime_;
  std::optional<std::int64_t> last_order_utime_;
  std::string other_reason_;  ///< of the first STOP with another reason
  double speed_m_s_ = 0.0;
};

}  // namespace adit
