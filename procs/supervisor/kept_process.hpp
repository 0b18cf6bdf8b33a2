// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/process_list/process_list.hpp"
#include "procs/supervisor/keeping/output_log.hpp"
#include "procs/supervisor/keeping/process_life.hpp"
#include "procs/supervisor/keeping/publish_rate.hpp"
#include "procs/supervisor/os/child_process.hpp"
#include "procs/supervisor/os/process_log.hpp"
#include "procs/supervisor/os/usage_meter.hpp"

namespace adit {

struct KeeperOptions {
  std::string deputy;             ///< whose commands of the list are kept
  std::filesystem::path watcher;  ///< adit-watch
  RestartPace pace = {};
  std::filesystem::path log_dir = {};  ///< for what they print; empty: no files
  RotatedFile::Limits log_limits = {};
};

/// One command of the list, kept as it is wanted: its life and the process that lives it. Times are
/// those of steady_us().
class KeptProcess {
 public:
  KeptProcess(const ListedCommand& command, const KeeperOptions& options);
  KeptProcess(const KeptProcess&) = delete;
  KeptProcess& operator=(const KeptProcess&) = delete;

  void start();
  void stop(std::int64_t now_us);
  void restart(std::int64_t now_us);
  /// It is to stop, or to restart, when its turn has come: until then nobody is to start on it.
  void announce_stop() { leaves_ = true; }
  /// From its next start on it is this command; at once where it does not run.
  void list_as(const ListedCommand& command);
  /// As procman's deputies take orders: another run id asks for a new run.
  void order(std::int32_t run_id, bool stop, std::int64_t now_us);
  /// A message came on the channel that shows its life.
  void heard(std::int64_t now_us);

  /// Does what is to be done. Whether anything about it has changed.
  bool advance(std::int64_t now_us, bool dependencies_work);
  void measure(const ProcessTable& table, std::int64_t now_us);

  [[nodiscard]] const ListedCommand& command() const { return command_; }
  [[nodiscard]] const ProcessLife& life() const { return life_; }
  [[nodiscard]] const OutputLog& output() const { return output_; }
  /// Whether others can depend on it.
  [[nodiscard]] bool works() const;
  /// Why what it prints does not get into its file; empty where it does.
  [[nodiscard]] std::string log_trouble() const { return log_.trouble(); }
  [[nodiscard]] const ProcessUse& use() const { return use_; }
  [[nodiscard]] std::int32_t run_id() const { return run_id_; }
  /// Of its last end, as waitpid has it.
  [[nodiscard]] int wait_status() const { return wait_status_; }
  /// 0 where it does not run.
  [[nodiscard]] pid_t pid() const { return child_ ? child_->pid() : 0; }
  [[nodiscard]] pid_t watcher() const { return child_ ? child_->watcher() : 0; }

 private:
  void launch(std::int64_t now_us);
  void take_next_listing();
  void note(const std::string& what);
  void look_after_child(std::int64_t now_us);
  void act(ProcessLife::Act what, std::int64_t now_us);

  ListedCommand command_;
  std::optional<ListedCommand> next_listing_;
  KeeperOptions options_;
  ProcessLife life_;
  PublishRate rate_;
  ProcessLog log_;
  OutputLog output_;
  UsageMeter meter_;
  ProcessUse use_;
  std::int64_t measured_us_ = 0;  ///< the last time, or when it was started
  std::unique_ptr<ChildProcess> child_;
  bool leaves_ = false;
  std::int32_t run_id_ = 0;
  int wait_status_ = 0;
};

}  // namespace adit
