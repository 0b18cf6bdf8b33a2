// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/kept_process.hpp"

#include <csignal>
#include <stdexcept>
#include <utility>

#include "procs/supervisor/os/wall_time.hpp"

namespace adit {
namespace {

// A program that prints faster than this at each look waits until the next.
constexpr std::size_t kOutputBytesMax = 256 * 1024;

LifeRules rules_of(const ListedCommand& command, const RestartPace& pace) {
  return {command.auto_respawn,      command.stop_time_allowed_s, command.restart_limit,
          command.alive.has_value(), command.start_timeout_s,     pace};
}

PublishRate rate_of(const ListedCommand& command) {
  return PublishRate(command.alive.value_or(AliveSign{}).rate_hz);
}

}  // namespace

KeptProcess::KeptProcess(const ListedCommand& command, const KeeperOptions& options)
    : command_(command),
      options_(options),
      life_(rules_of(command, options.pace)),
      rate_(rate_of(command)),
      log_(options.log_dir, command.id, options.log_limits),
      output_([this](const std::string& line) { log_.add(line, wall_utime()); }) {}

void KeptProcess::list_as(const ListedCommand& command) {
  next_listing_ = command;
  if (!child_) take_next_listing();
}

void KeptProcess::take_next_listing() {
  if (!next_listing_) return;
  command_ = *next_listing_;
  next_listing_.reset();
  life_.go_by(rules_of(command_, options_.pace));
  rate_ = rate_of(command_);
}

/// A word of the supervisor's own in the file.
void KeptProcess::note(const std::string& what) { log_.add("--- " + what, wall_utime()); }

void KeptProcess::start() {
  leaves_ = false;
  life_.want_running();
}

void KeptProcess::stop(std::int64_t now_us) {
  leaves_ = false;
  life_.want_stopped(now_us);
}

void KeptProcess::restart(std::int64_t now_us) {
  leaves_ = false;
  life_.want_restart(now_us);
}

void KeptProcess::order(std::int32_t run_id, bool stop, std::int64_t now_us) {
  if (stop) return this->stop(now_us);
  if (std::exchange(run_id_, run_id) != run_id) restart(now_us);
}

void KeptProcess::heard(std::int64_t now_us) {
  if (child_) rate_.heard(now_us);
}

bool KeptProcess::advance(std::int64_t now_us, bool dependencies_work) {
  const LifeState state = life_.state();
  const pid_t pid = this->pid();
  if (child_) look_after_child(now_us);
  act(life_.advance(now_us, dependencies_work, rate_.is_kept(now_us)), now_us);
  log_.flush();
  return state != life_.state() || pid != this->pid();
}

/// Not while only what the program left behind still runs.
bool KeptProcess::works() const {
  return !leaves_ && life_.state() == LifeState::kWorking && child_ && !child_->program_has_ended();
}

void KeptProcess::look_after_child(std::int64_t now_us) {
  const auto end = child_->poll();
  output_.add(child_->read_output(kOutputBytesMax));
  if (!end) return;
  output_.end_line();
  wait_status_ = end->wait_status;
  use_ = {};
  child_.reset();
  life_.ended(now_us, end->text(), end->well());
  note(end->text());
}

void KeptProcess::act(ProcessLife::Act what, std::int64_t now_us) {
  switch (what) {
    case ProcessLife::Act::kNothing:
      return;
    case ProcessLife::Act::kStart:
      return launch(now_us);
    case ProcessLife::Act::kAskToStop:
      return child_->send(command_.stop_signal);
    case ProcessLife::Act::kKill:
      return child_->send(SIGKILL);
  }
}

void KeptProcess::launch(std::int64_t now_us) {
  take_next_listing();
  rate_.forget();
  meter_ = {};
  measured_us_ = now_us;
  try {
    child_ = std::make_unique<ChildProcess>(
        ChildStart{*parse_command_line(command_.exec), command_.stop_signal,
                   command_.stop_time_allowed_s, options_.watcher});
    life_.started(now_us);
    note("started: " + command_.exec);
  } catch (const std::runtime_error& error) {
    life_.could_not_start(now_us, error.what());
    output_.add(std::string(error.what()) + "\n");
  }
}

void KeptProcess::measure(const ProcessTable& table, std::int64_t now_us) {
  const std::int64_t since_us = now_us - std::exchange(measured_us_, now_us);
  if (!child_) return;
  use_ = meter_.measure(table, child_->watcher(), now_us);
  if (use_.waits_for_disk) rate_.excuse(now_us, since_us);
}

}  // namespace adit
