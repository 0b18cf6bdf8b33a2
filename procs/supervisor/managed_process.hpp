// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/process_list/process_list.hpp"
#include "procs/supervisor/management/answer_monitor.hpp"
#include "procs/supervisor/management/output_log.hpp"
#include "procs/supervisor/management/process_lifecycle.hpp"
#include "procs/supervisor/management/publish_rate_monitor.hpp"
#include "procs/supervisor/os/child_process.hpp"
#include "procs/supervisor/os/process_log.hpp"
#include "procs/supervisor/os/procfs.hpp"

namespace adit {

struct ProcessManagerOptions {
  std::string deputy;             ///< commands of this deputy are managed
  std::filesystem::path watcher;  ///< path of adit-watch
  RestartBackoff backoff = {};
  std::filesystem::path log_dir = {};  ///< folder of the log files; empty: no files
  RotatedFile::Limits log_limits = {};
};

/// One command of the list: its lifecycle, its process and its output. Times are steady_us().
class ManagedProcess {
 public:
  ManagedProcess(const ListedCommand& command, const ProcessManagerOptions& options);
  ManagedProcess(const ManagedProcess&) = delete;
  ManagedProcess& operator=(const ManagedProcess&) = delete;

  void start();
  void stop(std::int64_t now_us);
  void restart(std::int64_t now_us);
  /// A stop or restart is pending; until then no dependent may start.
  void announce_stop() { stop_announced_ = true; }
  /// Replaces the command at the next start, or immediately if the process does not run.
  void update_command(const ListedCommand& command);
  /// Executes an order as procman's deputy does: a new run id requests a restart.
  void order(std::int32_t run_id, bool stop, std::int64_t now_us);
  /// A message was received on a channel, by which the process may show that it is alive or
  /// answers.
  void on_message(std::string_view channel, std::int64_t now_us);

  /// Polls the process and executes lifecycle actions. Returns whether its state or pid has
  /// changed.
  bool advance(std::int64_t now_us, bool dependencies_ready);
  void measure(const ProcessTable& table, std::int64_t now_us);

  [[nodiscard]] const ListedCommand& command() const { return command_; }
  [[nodiscard]] const ProcessLifecycle& lifecycle() const { return lifecycle_; }
  [[nodiscard]] const OutputLog& output() const { return output_; }
  /// Whether its dependents may start.
  [[nodiscard]] bool is_ready() const;
  /// Why the log file cannot be written; empty if it can.
  [[nodiscard]] std::string log_error() const { return log_.error(); }
  [[nodiscard]] const ResourceUsage& usage() const { return usage_; }
  [[nodiscard]] std::int32_t run_id() const { return run_id_; }
  /// Of the last end, as returned by waitpid.
  [[nodiscard]] int wait_status() const { return wait_status_; }
  /// 0 if it does not run.
  [[nodiscard]] pid_t pid() const { return child_ ? child_->pid() : 0; }
  [[nodiscard]] pid_t watcher() const { return child_ ? child_->watcher() : 0; }

 private:
  void launch(std::int64_t now_us);
  void apply_next_command();
  void log_event(const std::string& what);
  [[nodiscard]] Answers answers() const;
  void poll_child(std::int64_t now_us);
  void apply(ProcessLifecycle::Act act, std::int64_t now_us);

  ListedCommand command_;
  std::optional<ListedCommand> next_command_;
  ProcessManagerOptions options_;
  ProcessLifecycle lifecycle_;
  PublishRateMonitor rate_;
  AnswerMonitor answer_;
  ProcessLog log_;
  OutputLog output_;
  UsageMeter meter_;
  ResourceUsage usage_;
  std::int64_t measured_us_ = 0;  ///< time of the last measurement or of the start
  std::unique_ptr<ChildProcess> child_;
  bool stop_announced_ = false;
  std::int32_t run_id_ = 0;
  int wait_status_ = 0;
};

}  // namespace adit
