// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/phase_trace.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/mission_phase.hpp"
#include "common/messages/stop_order.hpp"

namespace adit {
namespace {

constexpr std::size_t kWaiting = 100;

}  // namespace

PhaseTrace::PhaseTrace(Bus& bus, const std::filesystem::path& file, std::function<double()> now_s)
    : file_(file, std::ios::app), now_s_(std::move(now_s)) {
  subscribe<phase_t>(bus, channels::kPhase, Delivery::queued(kWaiting),
                     [this](const MissionPhase& phase) {
                       if (std::exchange(sequence_, phase.sequence) != phase.sequence) write(phase);
                     });
  subscribe<stop_t>(bus, channels::kStop, Delivery::queued(kWaiting),
                    [this](const StopOrder& order) {
                      const bool news = std::exchange(stop_, order.reason) != order.reason;
                      if (!order.stopped || !news) return;
                      file_ << now_s_() << "\tSTOP\t" << order.reason << std::endl;
                    });
}

void PhaseTrace::write(const MissionPhase& phase) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%.1f\t%d\t%s\t%d\t%d\t%s\t%.1f\t%.0f\t", now_s_(),
                static_cast<int>(phase.phase), phase.homeward ? "home" : "out", phase.goal_id,
                phase.stub, phase.laser == LaserId::kFront ? "front" : "rear", phase.travelled_m,
                phase.remaining_m);
  file_ << text.data() << phase.reason << std::endl;
}

}  // namespace adit
