// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "common/process_list/process_list.hpp"
#include "procs/supervisor/keeping/output_log.hpp"
#include "procs/supervisor/keeping/process_life.hpp"
#include "procs/supervisor/keeping/publish_rate.hpp"
#include "procs/supervisor/os/child_process.hpp"
#include "procs/supervisor/os/usage_meter.hpp"

namespace adit {

/// One command of the list, kept as it is wanted: its life and the process that lives it. Times are
/// those of steady_us().
class KeptProcess {
 public:
  KeptProcess(const ListedCommand& command, const RestartPace& pace, std::filesystem::path watcher);

  void start() { life_.want_running(); }
  void stop(std::int64_t now_us) { life_.want_stopped(now_us); }
  void restart(std::int64_t now_us) { life_.want_restart(now_us); }
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
  [[nodiscard]] bool works() const;
  [[nodiscard]] const ProcessUse& use() const { return use_; }
  [[nodiscard]] std::int32_t run_id() const { return run_id_; }
  /// Of its last end, as waitpid has it.
  [[nodiscard]] int wait_status() const { return wait_status_; }
  /// 0 where it does not run.
  [[nodiscard]] pid_t pid() const { return child_ ? child_->pid() : 0; }
  [[nodiscard]] pid_t watcher() const { return child_ ? child_->watcher() : 0; }

 private:
  void launch(std::int64_t now_us);
  void look_after_child(std::int64_t now_us);
  void act(ProcessLife::Act what, std::int64_t now_us);

  ListedCommand command_;
  std::filesystem::path watcher_path_;
  ProcessLife life_;
  PublishRate rate_;
  OutputLog output_;
  UsageMeter meter_;
  ProcessUse use_;
  std::unique_ptr<ChildProcess> child_;
  std::int32_t run_id_ = 0;
  int wait_status_ = 0;
};

}  // namespace adit
