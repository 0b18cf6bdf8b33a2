// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/fleet_health.hpp"

#include <algorithm>

namespace adit {

std::string complaint_about(const Keeper& keeper) {
  for (const KeptProcess& process : keeper.processes()) {
    const LifeState state = process.life().state();
    if (state == LifeState::kFailed || state == LifeState::kPausing) {
      return process.command().id + " is " + std::string(name_of(state)) + ": " +
             process.life().trouble();
    }
  }
  for (const KeptProcess& process : keeper.processes()) {
    if (!process.log_trouble().empty()) return process.log_trouble();
  }
  return {};
}

bool any_given_up(const Keeper& keeper) {
  return std::ranges::any_of(keeper.processes(), [](const KeptProcess& process) {
    return process.life().state() == LifeState::kFailed;
  });
}

std::string count_of_running(const Keeper& keeper) {
  const auto running = std::ranges::count_if(keeper.processes(), [](const KeptProcess& process) {
    return process.life().state() == LifeState::kWorking;
  });
  return std::to_string(running) + " of " + std::to_string(keeper.processes().size()) +
         " processes run";
}

}  // namespace adit
