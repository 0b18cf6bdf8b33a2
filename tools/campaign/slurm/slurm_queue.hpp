// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace adit {

/// A task of a job array, as squeue lists it.
struct SlurmTask {
  std::string job;     ///< number of the array
  std::string name;    ///< of the array
  int index = 0;       ///< SLURM_ARRAY_TASK_ID
  std::string state;   ///< "PENDING", "RUNNING", "COMPLETED", "NODE_FAIL", ...
  std::string reason;  ///< why it is pending

  /// Whether it has ended for good.
  [[nodiscard]] bool has_ended() const;
  /// Whether Slurm holds it, since it could not be started on a node.
  [[nodiscard]] bool is_held() const;
};

/// The line of squeue "JOB|NAME|INDEX|STATE|REASON"; nothing for other lines.
std::optional<SlurmTask> parse_slurm_task(const std::string& line);

/// The commands of Slurm. A controller that does not answer, as while it is restarted, is no error:
/// the caller tries again.
class SlurmQueue {
 public:
  /// `watcher`: path of adit-watch.
  explicit SlurmQueue(std::filesystem::path watcher) : watcher_(std::move(watcher)) {}

  /// Throws std::runtime_error if Slurm is not installed here.
  void require_installed() const;

  /// All tasks of this user, also those that ended some minutes ago; nothing if the controller does
  /// not answer.
  [[nodiscard]] std::optional<std::vector<SlurmTask>> tasks() const;

  /// Submits a script. Returns false if the controller does not answer. Throws std::runtime_error
  /// with the reason of sbatch if it is rejected.
  [[nodiscard]] bool submit(const std::filesystem::path& script) const;

  void cancel(const std::vector<std::string>& jobs) const;
  /// Lets a task that is held start again.
  void release(const SlurmTask& task) const;

 private:
  struct Output {
    bool succeeded = false;
    std::string text;  ///< of standard output and standard error
  };

  [[nodiscard]] Output run(const std::vector<std::string>& arguments) const;

  std::filesystem::path watcher_;
};

}  // namespace adit
