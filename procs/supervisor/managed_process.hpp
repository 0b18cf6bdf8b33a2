// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/process_list/process_list.hpp"
#include "procs/supervisor/management/output_log.hpp"
#include "procs/supervisor/management/process_lifecycle.hpp"
#include "procs/supervisor/management/publish_rate_monitor.hpp"
#include "procs/supervisor/os/child_process.hpp"
#include "procs/supervisor/os/process_log.hpp"
#include "procs/supervisor/os/procfs.hpp"

namespace adit {

struct ProcessManagerOptions {
  std::string deputy;             ///< whose commands of the list are kept
  std::filesystem::path watcher;  ///< adit-watch
  RestartBackoff backoff = {};
  std::filesystem::path log_dir = {};  ///< for what they print; empty: no files
  RotatedFile::Limits log_limits = {};
};

/// One command of the list, kept as it is wanted: its life and the process that lives it. Times are
/// those of steady_us().
class ManagedProcess {
 public:
  ManagedProcess(const ListedCommand& command, const ProcessManagerOptions& options);
  ManagedProcess(const ManagedProcess&) = delete;
  ManagedProcess& operator=(const ManagedProcess&) = delete;

  void start();
  void stop(std::int64_t now_us);
  void restart(std::int64_t now_us);
  /// It is to stop, or to restart, when its turn has come: until then nobody is to start on it.
  void announce_stop() { stop_announced_ = true; }
  /// From its next start on it is this command; at once where it does not run.
  void update_command(const ListedCommand& command);
  /// As procman's deputies take orders: another run id asks for a new run.
  void order(std::int32_t run_id, bool stop, std::int64_t now_us);
  /// A message came on the channel that shows its life.
  void on_message(std::int64_t now_us);

  /// Does what is to be done. Whether anything about it has changed.
  bool advance(std::int64_t now_us, bool dependencies_ready);
  void measure(const ProcessTable& table, std::int64_t now_us);

  [[nodiscard]] const ListedCommand& command() const { return command_; }
  [[nodiscard]] const ProcessLifecycle& lifecycle() const { return lifecycle_; }
  [[nodiscard]] const OutputLog& output() const { return output_; }
  /// Whether others can depend on it.
  [[nodiscard]] bool is_ready() const;
  /// Why what it prints does not get into its file; empty where it does.
  [[nodiscard]] std::string log_error() const { return log_.error(); }
  [[nodiscard]] const ResourceUsage& usage() const { return usage_; }
  [[nodiscard]] std::int32_t run_id() const { return run_id_; }
  /// Of its last end, as waitpid has it.
  [[nodiscard]] int wait_status() const { return wait_status_; }
  /// 0 where it does not run.
  [[nodiscard]] pid_t pid() const { return child_ ? child_->pid() : 0; }
  [[nodiscard]] pid_t watcher() const { return child_ ? child_->watcher() : 0; }

 private:
  void launch(std::int64_t now_us);
  void apply_next_command();
  void log_event(const std::string& what);
  void poll_child(std::int64_t now_us);
  void apply(ProcessLifecycle::Act what, std::int64_t now_us);

  ListedCommand command_;
  std::optional<ListedCommand> next_command_;
  ProcessManagerOptions options_;
  ProcessLifecycle lifecycle_;
  PublishRateMonitor rate_;
  ProcessLog log_;
  OutputLog output_;
  UsageMeter meter_;
  ResourceUsage usage_;
  std::int64_t measured_us_ = 0;  ///< the last time, or when it was started
  std::unique_ptr<ChildProcess> child_;
  bool stop_announced_ = false;
  std::int32_t run_id_ = 0;
  int wait_status_ = 0;
};

}  // namespace adit
