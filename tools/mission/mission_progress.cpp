// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_progress.hpp"

#include <cstddef>
#include <ostream>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

constexpr std::size_t kTraceQueued = 100;

}  // namespace

std::string progress_text(const MissionProgress& progress, double factor) {
  const MissionPhase& phase = progress.phase;
  return fmt::format(
      "{:6.0f} s  {:<8} {}  {:6.1f} m driven, {:6.1f} m from the start, {:3} local maps, "
      "{:3} scans, {:.1f} x real time",
      progress.simulated_s, name_of(phase.phase), phase.returning_home ? "returning" : "outbound ",
      phase.distance_travelled_m, progress.distance_from_start_m, progress.local_maps, phase.scans,
      factor);
}

PhaseTrace::PhaseTrace(Bus& bus, const std::filesystem::path& file, std::function<double()> now_s)
    : file_(file, std::ios::app), now_s_(std::move(now_s)) {
  subscribe<phase_t>(bus, channels::kPhase, Delivery::queued(kTraceQueued),
                     [this](const MissionPhase& phase) {
                       if (std::exchange(sequence_, phase.sequence) != phase.sequence) write(phase);
                     });
  subscribe<stop_t>(bus, channels::kStop, Delivery::queued(kTraceQueued),
                    [this](const StopOrder& order) {
                      const bool is_new = std::exchange(stop_, order.reason) != order.reason;
                      if (!order.stopped || !is_new) return;
                      file_ << now_s_() << "\tSTOP\t" << order.reason << std::endl;
                    });
}

void PhaseTrace::write(const MissionPhase& phase) {
  file_ << fmt::format("{:.1f}\t{}\t{}\t{}\t{}\t{}\t{:.1f}\t{:.0f}\t{}", now_s_(),
                       static_cast<int>(phase.phase), phase.returning_home ? "home" : "out",
                       phase.goal_id, phase.frontier.value_or(-1),
                       phase.laser == LaserId::kFront ? "front" : "rear",
                       phase.distance_travelled_m, phase.remaining_m, phase.reason)
        << std::endl;
}

}  // namespace adit
