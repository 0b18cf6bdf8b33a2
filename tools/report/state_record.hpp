// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/bus/bus.hpp"
#include "common/exploration/exploration_report.hpp"
#include "common/sensing/ground_and_air.hpp"
#include "common/vehicle/drive_command.hpp"
#include "common/vehicle/run_state.hpp"

namespace adit {

/// The worst of the air on the way.
struct AirExtremes {
  double methane_share = 0.0;
  double oxygen_share = 1.0;
  double carbon_monoxide_share = 0.0;
};

/// Listens to what counts by its last message, or by its least and greatest.
class StateRecord {
 public:
  /// `bus` must outlive this.
  explicit StateRecord(Bus& bus);

  [[nodiscard]] const std::optional<ExplorationReport>& exploration() const { return exploration_; }
  /// When exploration decided to go home and did not change its mind.
  [[nodiscard]] std::optional<std::int64_t> home_utime() const { return home_utime_; }
  [[nodiscard]] const std::string& home_reason() const { return home_reason_; }
  [[nodiscard]] const std::optional<RunState>& run() const { return run_; }
  [[nodiscard]] const std::optional<AirExtremes>& air() const { return air_; }
  [[nodiscard]] const std::optional<VehicleState>& vehicle_first() const { return vehicle_first_; }
  [[nodiscard]] const std::optional<VehicleState>& vehicle_last() const { return vehicle_last_; }

 private:
  void on_exploration(const ExplorationReport& report);
  void on_gas(const GasReading& reading);

  std::optional<ExplorationReport> exploration_;
  std::optional<std::int64_t> home_utime_;
  std::string home_reason_;
  std::optional<RunState> run_;
  std::optional<AirExtremes> air_;
  std::optional<VehicleState> vehicle_first_;
  std::optional<VehicleState> vehicle_last_;
};

}  // namespace adit
