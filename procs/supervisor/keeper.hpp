// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/process_list/process_list.hpp"
#include "procs/supervisor/kept_process.hpp"

namespace adit {

struct KeeperOptions {
  std::string deputy;             ///< whose commands of the list are kept
  std::filesystem::path watcher;  ///< adit-watch
  RestartPace pace;
};

/// Keeps the processes of one computer. Nothing that these start outlives it, however it ends: see
/// ChildProcess; and should one of the watchers be killed, those that it watched over come to this
/// process (PR_SET_CHILD_SUBREAPER), which kills them. Times are those of steady_us().
class Keeper {
 public:
  /// Whether a command of another computer works.
  using WorksElsewhere = std::function<bool(const std::string& id)>;

  Keeper(const ProcessList& list, const KeeperOptions& options);
  /// Stops all, as stop_all does, and waits for that.
  ~Keeper();
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  /// Null where the command is none of this computer's.
  [[nodiscard]] KeptProcess* find(const std::string& id);
  [[nodiscard]] const std::vector<KeptProcess>& processes() const { return processes_; }

  void heard(std::string_view channel, std::int64_t now_us);

  /// To be called every few hundredths of a second. Whether anything has changed.
  bool advance(std::int64_t now_us, const WorksElsewhere& works_elsewhere);

  /// How much each process uses; about once a second.
  void measure(std::int64_t now_us);

  void stop_all(std::int64_t now_us);
  [[nodiscard]] bool anything_runs() const;

 private:
  [[nodiscard]] bool dependencies_work(const KeptProcess& process,
                                       const WorksElsewhere& works_elsewhere);
  void kill_strays(const ProcessTable& table) const;

  std::vector<KeptProcess> processes_;  // in the order of the list
};

}  // namespace adit
