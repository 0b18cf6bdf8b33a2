// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_progress.hpp"

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr std::size_t kPhasesQueued = 1000;

}  // namespace

std::string progress_text(const MissionProgress& progress, double factor) {
  const MissionPhase& phase = progress.phase;
  return fmt::format(
      "{:6.0f} s  {:<8} {}  {:6.1f} m driven, {:6.1f} m from the start, {:3} local maps, "
      "{:3} scans, {:.1f} x real time{}",
      progress.simulated_s, name_of(phase.phase), phase.returning_home ? "returning" : "outbound ",
      phase.distance_travelled_m, progress.distance_from_start_m, progress.local_maps, phase.scans,
      factor, progress.not_stored.empty() ? "" : ", not all is stored");
}

MissionFollower::MissionFollower(Bus& bus, const std::filesystem::path& file,
                                 std::function<double()> simulated_s)
    : path_(file), file_(file, std::ios::app), simulated_s_(std::move(simulated_s)) {
  const Delivery all = Delivery::queued(kPhasesQueued);
  subscribe<phase_t>(bus, channels::kPhase, all,
                     [this](const MissionPhase& phase) { on_phase(phase); });
  subscribe<stop_t>(bus, channels::kStop, all, [this](const StopOrder& order) {
    const bool is_new = std::exchange(written_stop_, order.reason) != order.reason;
    if (!order.stopped || !is_new) return;
    file_ << fmt::format("{:g}\tSTOP\t{}", simulated_s_(), message_line(order.reason)) << std::endl;
  });
  subscribe<map_correction_t>(bus, channels::kMapCorrection, all,
                              [this](const MapCorrection& correction) {
                                local_maps_ = std::max(local_maps_, correction.local_map + 1);
                              });
}

void MissionFollower::on_phase(const MissionPhase& phase) {
  if (std::exchange(written_sequence_, phase.sequence) != phase.sequence) write(phase);
  if (phase_.phase != Phase::kEnded) ended_s_ = simulated_s_();
  phase_ = phase;
}

void MissionFollower::write(const MissionPhase& phase) {
  file_ << fmt::format("{:.1f}\t{}\t{}\t{}\t{}\t{}\t{:.1f}\t{:.0f}\t{}", simulated_s_(),
                       static_cast<int>(phase.phase), phase.returning_home ? "home" : "out",
                       phase.goal_id, phase.frontier.value_or(-1),
                       phase.laser == LaserId::kFront ? "front" : "rear",
                       phase.distance_travelled_m, phase.remaining_m, message_line(phase.reason))
        << std::endl;
}

void MissionFollower::set_distance_from_start(double distance_m) {
  distance_from_start_m_ = distance_m;
  farthest_m_ = std::max(farthest_m_, distance_m);
}

void MissionFollower::add_not_stored(const std::string& line) {
  const bool is_known = std::ranges::find(not_stored_, line) != not_stored_.end();
  if (!line.empty() && !is_known) not_stored_.push_back(line);
}

MissionProgress MissionFollower::progress() const {
  return {phase_, simulated_s_(), distance_from_start_m_, local_maps_, not_stored_};
}

std::string MissionFollower::failure() const {
  return file_ ? "" : fmt::format("cannot write {}", path_.string());
}

bool MissionFollower::has_ended(double for_s) const {
  return phase_.phase == Phase::kEnded && simulated_s_() > ended_s_ + for_s;
}

}  // namespace adit
