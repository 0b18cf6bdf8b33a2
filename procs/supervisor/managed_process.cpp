// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/managed_process.hpp"

#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <utility>

#include "common/config/number_text.hpp"
#include "common/service/wall_time.hpp"

namespace adit {
namespace {

// Read per advance(). A program that prints faster blocks until the next one.
constexpr std::size_t kOutputBytesMax = 256 * 1024;

std::string ignored_input_text(const AnswerRule& answer) {
  std::string inputs;
  for (const std::string& input : answer.inputs) inputs += (inputs.empty() ? "" : ", ") + input;
  return "ignored its input: no " + answer.channel + " for " + number_text(answer.timeout_s) +
         " s while " + inputs + " came";
}

LifecycleRules rules_of(const ListedCommand& command, const RestartBackoff& backoff) {
  return {command.auto_respawn,
          command.stop_time_allowed_s,
          command.restart_limit,
          command.alive.has_value(),
          command.start_timeout_s,
          backoff,
          command.answer ? ignored_input_text(*command.answer) : ""};
}

AnswerMonitor answer_of(const ListedCommand& command) {
  const AnswerRule rule = command.answer.value_or(AnswerRule{});
  return AnswerMonitor(rule.timeout_s, rule.late);
}

PublishRateMonitor rate_of(const ListedCommand& command) {
  return PublishRateMonitor(command.alive.value_or(LivenessSignal{}).rate_hz);
}

}  // namespace

ManagedProcess::ManagedProcess(const ListedCommand& command, const ProcessManagerOptions& options)
    : command_(command),
      options_(options),
      lifecycle_(rules_of(command, options.backoff)),
      rate_(rate_of(command)),
      answer_(answer_of(command)),
      log_(options.log_dir, command.id, options.log_limits),
      output_([this](const std::string& line) { log_.add(line, wall_utime()); }) {}

void ManagedProcess::update_command(const ListedCommand& command) {
  next_command_ = command;
  if (!child_) apply_next_command();
}

void ManagedProcess::apply_next_command() {
  if (!next_command_) return;
  command_ = *next_command_;
  next_command_.reset();
  lifecycle_.set_rules(rules_of(command_, options_.backoff));
  rate_ = rate_of(command_);
  answer_ = answer_of(command_);
}

/// Adds a line of the supervisor to the log file.
void ManagedProcess::log_event(const std::string& what) { log_.add("--- " + what, wall_utime()); }

void ManagedProcess::start() {
  stop_announced_ = false;
  lifecycle_.request_start();
}

void ManagedProcess::stop(std::int64_t now_us) {
  stop_announced_ = false;
  lifecycle_.request_stop(now_us);
}

void ManagedProcess::restart(std::int64_t now_us) {
  stop_announced_ = false;
  lifecycle_.request_restart(now_us);
}

void ManagedProcess::order(std::int32_t run_id, bool stop, std::int64_t now_us) {
  if (stop) return this->stop(now_us);
  if (std::exchange(run_id_, run_id) != run_id) restart(now_us);
}

void ManagedProcess::on_message(std::string_view channel, std::int64_t now_us) {
  if (!child_) return;
  if (command_.alive && command_.alive->channel == channel) rate_.on_message(now_us);
  if (!command_.answer) return;
  const AnswerRule& answer = *command_.answer;
  if (std::ranges::find(answer.inputs, channel) != answer.inputs.end()) answer_.on_input(now_us);
  if (answer.channel == channel) answer_.on_answer();
}

Answers ManagedProcess::answers() const {
  if (answer_.is_ignored()) return Answers::kMissing;
  return answer_.is_unanswered() ? Answers::kAwaited : Answers::kGiven;
}

bool ManagedProcess::advance(std::int64_t now_us, bool dependencies_ready) {
  const LifecycleState state = lifecycle_.state();
  const pid_t pid = this->pid();
  if (child_) poll_child(now_us);
  apply(lifecycle_.advance(now_us, dependencies_ready, rate_.is_met(now_us), answers()), now_us);
  if (state == LifecycleState::kRunning && lifecycle_.state() == LifecycleState::kStopping) {
    log_event("stopped: " + lifecycle_.error());
  }
  log_.flush();
  return state != lifecycle_.state() || pid != this->pid();
}

/// False while only descendants of an ended program run.
bool ManagedProcess::is_ready() const {
  return !stop_announced_ && lifecycle_.state() == LifecycleState::kRunning && child_ &&
         !child_->program_has_ended();
}

void ManagedProcess::poll_child(std::int64_t now_us) {
  const auto end = child_->poll();
  output_.add(child_->read_output(kOutputBytesMax));
  if (!end) return;
  output_.end_line();
  wait_status_ = end->wait_status;
  usage_ = {};
  child_.reset();
  lifecycle_.ended(now_us, end->text(), end->succeeded());
  log_event(end->text());
}

void ManagedProcess::apply(ProcessLifecycle::Act act, std::int64_t now_us) {
  switch (act) {
    case ProcessLifecycle::Act::kNothing:
      return;
    case ProcessLifecycle::Act::kStart:
      return launch(now_us);
    case ProcessLifecycle::Act::kRequestStop:
      return child_->send(command_.stop_signal);
    case ProcessLifecycle::Act::kKill:
      return child_->send(SIGKILL);
  }
}

void ManagedProcess::launch(std::int64_t now_us) {
  apply_next_command();
  rate_.reset();
  answer_.reset(now_us, command_.start_timeout_s);
  meter_ = {};
  measured_us_ = now_us;
  try {
    child_ = std::make_unique<ChildProcess>(
        ChildStart{*parse_command_line(command_.exec), command_.stop_signal,
                   command_.stop_time_allowed_s, options_.watcher});
    lifecycle_.started(now_us);
    log_event("started: " + command_.exec);
  } catch (const std::runtime_error& error) {
    lifecycle_.start_failed(now_us, error.what());
    output_.add(std::string(error.what()) + "\n");
  }
}

void ManagedProcess::measure(const ProcessTable& table, std::int64_t now_us) {
  const std::int64_t since_us = now_us - std::exchange(measured_us_, now_us);
  if (!child_) return;
  usage_ = meter_.measure(table, child_->watcher(), now_us);
  if (!usage_.in_disk_sleep) return;
  rate_.add_blocked_time(now_us, since_us);
  answer_.add_blocked_time(since_us);
}

}  // namespace adit
