// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/fleet.hpp"

#include <stdexcept>

namespace adit {
namespace {

using Kind = ScriptAction::Kind;

}  // namespace

Fleet::Fleet(const SupervisorSite& site, const RestartPace& pace)
    : site_(site),
      keeper_(site.list, {site.deputy, site.watcher, pace, site.log_dir, site.log_limits}),
      remotes_(site.list, site.deputy) {}

void Fleet::require_may_change(const std::string& id) {
  const ListedCommand* const command = site_.list.find(id);
  if (!command) throw std::invalid_argument("there is no process \"" + id + "\" in the list");
  if (!site_.in_charge && command->deputy != site_.deputy) {
    throw std::invalid_argument("\"" + id + "\" runs on " + command->deputy +
                                ", and this supervisor is not in charge");
  }
}

void Fleet::change(const ScriptChange& change, std::int64_t now_us) {
  for (const std::string& id : change.ids) require_may_change(id);
  for (const std::string& id : change.ids) {
    if (change.kind == Kind::kStart) {
      start(id);
    } else {
      stop_in_turn(*site_.list.find(id), change.kind == Kind::kRestart, now_us);
    }
  }
  stop_due(now_us);
}

void Fleet::stop_in_turn(const ListedCommand& command, bool and_start, std::int64_t now_us) {
  stops_.add(command, and_start, now_us);
  if (KeptProcess* const process = keeper_.find(command.id)) process->announce_stop();
}

void Fleet::start(const std::string& id) {
  stops_.forget(id);
  if (remotes_.has(id)) return remotes_.start(id);
  keeper_.find(id)->start();
}

void Fleet::stop(const OrderedStops::Stop& stop, std::int64_t now_us) {
  if (KeptProcess* const process = keeper_.find(stop.id)) {  // one that is gone from the list too
    if (stop.and_start) return process->restart(now_us);
    process->stop(now_us);
  } else if (remotes_.has(stop.id)) {
    if (stop.and_start) return remotes_.restart(stop.id);
    remotes_.stop(stop.id);
  }
}

/// Again and again, since what does not run is no longer in the way as soon as it was told.
void Fleet::stop_due(std::int64_t now_us) {
  const auto is_ending = [&](const std::string& id) {
    if (KeptProcess* const process = keeper_.find(id)) {
      return process->life().state() == LifeState::kStopping;
    }
    return remotes_.has(id) && remotes_.is_ending(id, now_us);
  };
  for (;;) {
    const auto due = stops_.take_due(now_us, is_ending);
    if (due.empty()) return;
    for (const OrderedStops::Stop& stop : due) this->stop(stop, now_us);
  }
}

void Fleet::relist(const ProcessList& before, std::int64_t now_us) {
  for (const ListedCommand& old : before.commands) {
    KeptProcess* const process = keeper_.find(old.id);
    const ListedCommand* const now = site_.list.find(old.id);
    if (!process || (now && *now == old)) continue;
    const LifeState state = process->life().state();
    const bool stays = now && now->deputy == site_.deputy;
    // One that was given up has another chance, now that it is another.
    const bool and_start = stays && (process->life().wanted() || state == LifeState::kFailed);
    if (!stays || and_start) stop_in_turn(old, and_start, now_us);
  }
  keeper_.relist(site_.list);
  remotes_.relist(site_.list);
  stop_due(now_us);
}

const OutputLog* Fleet::output(const std::string& id) {
  const KeptProcess* const process = keeper_.find(id);
  return process ? &process->output() : remote_output_.find(id);
}

Standing Fleet::standing(const std::string& id, std::int64_t now_us) {
  if (stops_.waits(id)) return Standing::kBetween;
  const KeptProcess* const process = keeper_.find(id);
  if (!process) return remotes_.standing(id, now_us);
  if (process->works()) return Standing::kWorking;
  const LifeState state = process->life().state();
  const bool rests = state == LifeState::kStopped || state == LifeState::kFailed;
  return rests ? Standing::kStopped : Standing::kBetween;
}

void Fleet::heard(std::string_view channel, std::int64_t now_us) {
  keeper_.heard(channel, now_us);
  remotes_.heard(channel, now_us);
}

bool Fleet::advance(std::int64_t now_us) {
  stop_due(now_us);
  return keeper_.advance(
      now_us, [&](const std::string& id) { return standing(id, now_us) == Standing::kWorking; });
}

}  // namespace adit
