// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/live_simulator.hpp"

#include <iostream>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/node/version.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/files/file_error.hpp"
#include "common/messages/sim.hpp"
#include "common/sensing/seconds.hpp"
#include "common/text/message_text.hpp"
#include "sim/live/sim_config.hpp"

namespace adit {
namespace {

constexpr std::size_t kMessageQueueSize = 4096;  // of one channel
constexpr std::size_t kAnswerQueueSize = 1000;
constexpr std::int64_t kRecordPeriodUs = 1'000'000;
constexpr std::int64_t kReminderUs = 500'000;  // of wall time

std::string state_of(const RunState& run, const VehicleState& vehicle) {
  if (!run.failure.empty()) return fmt::format("failed: {}", run.failure);
  if (vehicle.stopped) return "held by a stop order";
  if (vehicle.expired) return "without a command";
  return "driving";
}

std::string waiting_message(const std::string& stage) {
  return fmt::format(
      "waiting for {}, which has not answered for 5 s; was it started with --sim-time?", stage);
}

}  // namespace

BusRecorder::BusRecorder(Bus& bus, const std::filesystem::path& path, double free_min_mb,
                         Clock clock)
    : log_(path, free_min_mb), clock_(std::move(clock)) {
  for (const std::string_view channel : channels::kAll) {
    if (channel == channels::kSimTimeDone) continue;
    bus.subscribe(channel, Delivery::queued(kMessageQueueSize),
                  [this](const ReceivedMessage& received) -> std::string_view {
                    log_.write({clock_(), received.channel, received.bytes});
                    return {};
                  });
  }
  bus.create_timer(kRecordPeriodUs, [this, &bus](std::int64_t) {
    log_.check_space(clock_());
    if (log_.stopped().empty()) return;
    const LogEvent heartbeat = log_.heartbeat(clock_());
    bus.publish(heartbeat.channel, heartbeat.data);
  });
}

std::string progress_line(double elapsed_s, double factor, const RunState& run,
                          const VehicleState& vehicle) {
  return fmt::format("{:.1f} s simulated, {:.1f} x real time, {:.1f} m, {}", elapsed_s, factor,
                     run.distance_travelled_m, state_of(run, vehicle));
}

void ProgressReporter::update(const Simulation& simulation, std::int64_t start_utime,
                              std::int64_t wall_us) {
  const std::string& failure = simulation.state().failure;
  if (!failure.empty() && !failed_) print(fmt::format("the run has failed: {}", failure));
  failed_ = !failure.empty();

  const std::int64_t utime = simulation.utime();
  if (!last_) last_ = {utime, wall_us};
  if (wall_us - last_->wall_us < kPeriodUs) return;
  const double factor =
      static_cast<double>(utime - last_->utime) / static_cast<double>(wall_us - last_->wall_us);
  last_ = {utime, wall_us};
  print(progress_line(seconds(utime - start_utime), factor, simulation.state(),
                      simulation.vehicle().state()));
}

void ProgressReporter::print(const std::string& what) const { print_error(program_, what); }

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
    recorder_.emplace(bus, options.record, params.record_free_min_mb,
                      [this] { return node_.simulation().utime(); });
  }
  host_.set_health([this] { return node_.health(); });
  subscribe<sim_time_done_t>(host_.bus(), channels::kSimTimeDone,
                             Delivery::queued(kAnswerQueueSize), [this](const SimTimeDone& done) {
                               // A time in the future belongs to another simulator or a previous
                               // run.
                               if (done.utime <= node_.simulation().utime())
                                 pacing_.done(done.stage, done.utime);
                             });
  node_.publish_time();
}

std::int64_t LiveSimulator::advance(std::int64_t wall_us) {
  progress_.update(node_.simulation(), start_utime_, wall_us);
  report_record();
  const Pacing::Decision decision = pacing_.decide(node_.next_utime(), wall_us);
  if (decision.kind == Pacing::Decision::Kind::kStep) step();
  if (decision.kind == Pacing::Decision::Kind::kWaitForStages) remind_stages(wall_us);
  return decision.wait_us;
}

void LiveSimulator::step() {
  node_.step();
  const std::int64_t elapsed_us = node_.simulation().utime() - start_utime_;
  for (const auto& applied : process_faults_.advance(seconds(elapsed_us))) {
    progress_.print(applied.line);
    pacing_.exclude(applied.stage, node_.simulation().utime());
  }
}

/// A stage that started late or was restarted has missed SIM_TIME and would never answer without
/// it.
void LiveSimulator::remind_stages(std::int64_t wall_us) {
  for (const std::string& stage : pacing_.newly_timed_out(wall_us)) {
    progress_.print(waiting_message(stage));
  }
  if (wall_us < next_reminder_us_) return;
  next_reminder_us_ = wall_us + kReminderUs;
  node_.publish_time();
}

bool LiveSimulator::done() const {
  const std::int64_t elapsed_us = node_.simulation().utime() - start_utime_;
  return for_s_ && seconds(elapsed_us) >= *for_s_;
}

void LiveSimulator::report_record() {
  if (!recorder_ || record_stopped_ || recorder_->stopped().empty()) return;
  record_stopped_ = true;
  progress_.print(recorder_->stopped());
}

void LiveSimulator::close_record() {
  if (!recorder_) return;
  recorder_->close();
  if (!recorder_->stopped().empty()) throw FileError(recorder_->stopped());
}

}  // namespace adit
