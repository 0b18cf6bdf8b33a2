// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/live_simulator.hpp"

#include "common/bus/channels.hpp"
#include "common/bus/stages.hpp"
#include "common/bus/typed.hpp"
#include "common/bus/version.hpp"
#include "common/messages/sim_time.hpp"
#include "common/sensing/seconds.hpp"
#include "sim/live/settings.hpp"

namespace adit {
namespace {

constexpr std::size_t kAnswersWaiting = 1000;
constexpr std::int64_t kReminderUs = 500'000;  // of wall time

std::string why_it_waits(const std::string& stage) {
  std::string line = "waiting for ";
  line += stage;
  line += ", which has not answered for 5 s; was it started with --sim-time?";
  return line;
}

}  // namespace

LiveSimulator::LiveSimulator(Bus& bus, const Site& site, const WorldDescription& description,
                             const SimulationParams& params, const LiveRunOptions& options,
                             std::int64_t start_utime)
    : host_(bus, {kSimSection, version(), yaml_in_effect(params, description)}),
      node_(host_.bus(), site, params, static_cast<std::uint64_t>(description.seed), start_utime),
      pacing_(options.pacing),
      process_faults_(params.faults),
      progress_(options.program),
      start_utime_(start_utime),
      for_s_(options.for_s) {
  if (!options.record.empty()) {
    recorder_.emplace(bus, options.record, [this] { return node_.simulation().utime(); });
  }
  host_.set_health([this] { return node_.health(); });
  subscribe<sim_time_done_t>(host_.bus(), channels::kSimTimeDone, Delivery::queued(kAnswersWaiting),
                             [this](const SimTimeDone& done) {
                               // One from the future answers another simulator, or this one's
                               // predecessor.
                               if (done.utime <= node_.simulation().utime())
                                 pacing_.done(done.stage, done.utime);
                             });
  node_.send_time();
}

std::int64_t LiveSimulator::go_on(std::int64_t wall_us) {
  progress_.update(node_.simulation(), start_utime_, wall_us);
  const Pacing::Decision decision = pacing_.decide(node_.next_utime(), wall_us);
  if (decision.kind == Pacing::Decision::Kind::kStep) step();
  if (decision.kind == Pacing::Decision::Kind::kWaitForStages) remind_stages(wall_us);
  return decision.wait_us;
}

void LiveSimulator::step() {
  node_.step();
  const std::int64_t elapsed_us = node_.simulation().utime() - start_utime_;
  for (const auto& harm : process_faults_.advance(seconds(elapsed_us))) {
    progress_.say(harm.line);
    pacing_.give_up(harm.stage, node_.simulation().utime());
  }
}

/// What a stage missed that came late, or was started again, is the time: without it, it would
/// never answer.
void LiveSimulator::remind_stages(std::int64_t wall_us) {
  for (const std::string& stage : pacing_.newly_silent(wall_us)) {
    progress_.say(why_it_waits(stage));
  }
  if (wall_us < next_reminder_us_) return;
  next_reminder_us_ = wall_us + kReminderUs;
  node_.send_time();
}

bool LiveSimulator::done() const {
  const std::int64_t elapsed_us = node_.simulation().utime() - start_utime_;
  return for_s_ && seconds(elapsed_us) >= *for_s_;
}

void LiveSimulator::close_record() {
  if (recorder_) recorder_->close();
}

}  // namespace adit
