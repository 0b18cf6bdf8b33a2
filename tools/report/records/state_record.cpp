// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/state_record.hpp"

#include <algorithm>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 100;

}  // namespace

StateRecord::StateRecord(Bus& bus) {
  const Delivery all = Delivery::queued(kQueued);
  subscribe<exploration_t>(bus, channels::kExploration, all,
                           [this](const ExplorationReport& report) { on_exploration(report); });
  subscribe<run_state_t>(bus, channels::kRunState, all,
                         [this](const RunState& state) { run_state_ = state; });
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
  if (!home) return_home_utime_.reset();
  if (home && !return_home_utime_) {
    return_home_utime_ = report.utime;
    return_home_reason_ = report.decision.reason;
  }
  exploration_ = report;
}

void StateRecord::on_gas(const GasReading& reading) {
  if (!gas_extremes_) gas_extremes_.emplace();
  gas_extremes_->methane_share = std::max(gas_extremes_->methane_share, reading.methane_share);
  gas_extremes_->oxygen_share = std::min(gas_extremes_->oxygen_share, reading.oxygen_share);
  gas_extremes_->carbon_monoxide_share =
      std::max(gas_extremes_->carbon_monoxide_share, reading.carbon_monoxide_share);
}

}  // namespace adit
