// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/fleet_script.hpp"

#include <stdexcept>

namespace adit {

void FleetScript::begin(const std::string& name, const ProcessList& list, double timeout_s) {
  run_.emplace(list, name, timeout_s);
  failure_.clear();
}

bool FleetScript::advance(Fleet& fleet, std::int64_t now_us) {
  if (!run_) return false;
  bool changed = false;
  const auto standing_of = [&](const std::string& id) { return fleet.standing(id, now_us); };
  try {
    while (const auto change = run_->advance(now_us, standing_of)) {
      fleet.change(*change, now_us);
      changed = true;
    }
    if (!run_->is_over()) return changed;
    failure_ = run_->failure();
  } catch (const std::invalid_argument& refusal) {
    failure_ = "script \"" + run_->name() + "\": " + refusal.what();
  }
  run_.reset();
  return changed;
}

bool FleetScript::end(const std::string& why) {
  if (!run_) return false;
  failure_ = "script \"" + run_->name() + "\" " + why;
  run_.reset();
  return true;
}

}  // namespace adit
