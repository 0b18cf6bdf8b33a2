// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/exploration.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// Extreme gas readings of a mission.
struct GasExtremes {
  double methane_share = 0.0;
  double oxygen_share = 1.0;
  double carbon_monoxide_share = 0.0;
};

/// Collects the last EXPLORATION and RUN_STATE, the extremes of GAS, and the first and last
/// VEHICLE_STATE.
class StateRecord {
 public:
  /// `bus` must outlive this.
  explicit StateRecord(Bus& bus);

  [[nodiscard]] const std::optional<ExplorationReport>& exploration() const { return exploration_; }
  /// Time of the decision of exploration to return home, unless it was revised later.
  [[nodiscard]] std::optional<std::int64_t> return_home_utime() const { return return_home_utime_; }
  [[nodiscard]] const std::string& return_home_reason() const { return return_home_reason_; }
  [[nodiscard]] const std::optional<RunState>& run_state() const { return run_state_; }
  [[nodiscard]] const std::optional<GasExtremes>& gas_extremes() const { return gas_extremes_; }
  [[nodiscard]] const std::optional<VehicleState>& vehicle_first() const { return vehicle_first_; }
  [[nodiscard]] const std::optional<VehicleState>& vehicle_last() const { return vehicle_last_; }

 private:
  void on_exploration(const ExplorationReport& report);
  void on_gas(const GasReading& reading);

  std::optional<ExplorationReport> exploration_;
  std::optional<std::int64_t> return_home_utime_;
  std::string return_home_reason_;
  std::optional<RunState> run_state_;
  std::optional<GasExtremes> gas_extremes_;
  std::optional<VehicleState> vehicle_first_;
  std::optional<VehicleState> vehicle_last_;
};

}  // namespace adit
