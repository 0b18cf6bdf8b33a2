// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/state_record.hpp"

#include <algorithm>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/exploration_report.hpp"
#include "common/messages/gas_reading.hpp"
#include "common/messages/run_state.hpp"
#include "common/messages/vehicle_state.hpp"

namespace adit {
namespace {

constexpr std::size_t kWaiting = 100;

}  // namespace

StateRecord::StateRecord(Bus& bus) {
  const Delivery all = Delivery::queued(kWaiting);
  subscribe<exploration_t>(bus, channels::kExploration, all,
                           [this](const ExplorationReport& report) { on_exploration(report); });
  subscribe<run_state_t>(bus, channels::kRunState, all,
                         [this](const RunState& state) { run_ = state; });
  subscribe<gas_t>(bus, channels::kGas, all,
                   [this](const GasReading& reading) { on_gas(reading); });
  subscribe<vehicle_state_t>(bus, channels::kVehicleState, all, [this](const VehicleState& state) {
    if (!vehicle_first_) vehicle_first_ = state;
    vehicle_last_ = state;
  });
}

void StateRecord::on_exploration(const ExplorationReport& report) {
  using Kind = ExplorationDecision::Kind;
  const bool home = report.decision.kind == Kind::kHome || report.decision.kind == Kind::kDone;
  if (!home) home_utime_.reset();
  if (home && !home_utime_) {
    home_utime_ = report.utime;
    home_reason_ = report.decision.reason;
  }
  exploration_ = report;
}

void StateRecord::on_gas(const GasReading& reading) {
  if (!air_) air_.emplace();
  air_->methane_share = std::max(air_->methane_share, reading.methane_share);
  air_->oxygen_share = std::min(air_->oxygen_share, reading.oxygen_share);
  air_->carbon_monoxide_share =
      std::max(air_->carbon_monoxide_share, reading.carbon_monoxide_share);
}

}  // namespace adit
