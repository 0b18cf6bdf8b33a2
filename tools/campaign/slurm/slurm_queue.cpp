// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/slurm/slurm_queue.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "common/config/number_text.hpp"
#include "common/files/file_utils.hpp"
#include "common/files/temporary_file.hpp"
#include "common/text/message_text.hpp"
#include "procs/supervisor/os/child_process.hpp"
#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {
namespace {

constexpr int kAnswerMaxMs = 60'000;  // squeue waits some 10 s for a controller that is restarted

bool has_any_of(const std::string& text, std::initializer_list<const char*> parts) {
  return std::ranges::any_of(
      parts, [&](const char* part) { return text.find(part) != std::string::npos; });
}

bool means_no_controller(const std::string& output) {
  return has_any_of(
      output, {"Unable to contact", "timed out", "Socket timed out", "Zero Bytes were transmitted",
               "Transport endpoint", "Resource temporarily unavailable", "not responding"});
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

bool SlurmTask::has_ended() const {
  return has_any_of(state, {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL",
                            "OUT_OF_MEMORY", "BOOT_FAIL", "DEADLINE", "PREEMPTED", "REVOKED"});
}

bool SlurmTask::is_held() const {
  return state == "PENDING" && has_any_of(reason, {"launch failed requeued held", "JobHeldAdmin"});
}

std::optional<SlurmTask> parse_slurm_task(const std::string& line) {
  std::array<std::string, 5> cells;
  std::istringstream in(line);
  for (std::string& cell : cells) std::getline(in, cell, '|');
  const auto index = parse_number<int>(cells[2]);
  if (!in || !index) return std::nullopt;
  return SlurmTask{cells[0], cells[1], *index, cells[3], cells[4]};
}

SlurmQueue::Output SlurmQueue::run(const std::vector<std::string>& arguments) const {
  const TemporaryFile file(std::filesystem::temp_directory_path());
  const FileDescriptor output(open(file.path().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  ChildStart start;
  start.line.arguments = arguments;
  start.stop_signal = SIGKILL;
  start.watcher = watcher_;
  start.output = output.get();
  ChildProcess child(start);
  const FileDescriptor ended(static_cast<int>(syscall(SYS_pidfd_open, child.watcher(), 0)));
  pollfd descriptor{ended.get(), POLLIN, 0};
  if (poll(&descriptor, 1, kAnswerMaxMs) <= 0) return {false, "timed out"};
  const auto end = child.poll();
  return {end && end->succeeded(), read_text_file(file.path())};
}

void SlurmQueue::require_installed() const {
  for (const char* program : {"sbatch", "squeue", "scancel"}) {
    std::string reason;
    try {
      const Output output = run({program, "--version"});
      if (output.succeeded) continue;
      reason = first_line(output.text);
    } catch (const std::runtime_error& error) {
      reason = error.what();
    }
    throw std::runtime_error(message_line(
        fmt::format("--on slurm requires {} (Debian: slurm-client): {}", program, reason)));
  }
}

std::optional<std::vector<SlurmTask>> SlurmQueue::tasks() const {
  const Output output =
      run({"squeue", "--noheader", "--array", "--states=all", "--me", "--format=%F|%j|%K|%T|%r"});
  if (!output.succeeded) return std::nullopt;
  std::vector<SlurmTask> tasks;
  std::istringstream lines(output.text);
  for (std::string line; std::getline(lines, line);) {
    if (auto task = parse_slurm_task(line)) tasks.push_back(std::move(*task));
  }
  return tasks;
}

bool SlurmQueue::submit(const std::filesystem::path& script) const {
  const Output output = run({"sbatch", "--parsable", script.string()});
  if (output.succeeded) return true;
  if (means_no_controller(output.text)) return false;
  throw std::runtime_error("sbatch: " + message_line(first_line(output.text)));
}

void SlurmQueue::cancel(const std::vector<std::string>& jobs) const {
  std::vector<std::string> arguments{"scancel"};
  arguments.insert(arguments.end(), jobs.begin(), jobs.end());
  if (!jobs.empty()) (void)run(arguments);
}

void SlurmQueue::release(const SlurmTask& task) const {
  (void)run({"scontrol", "release", fmt::format("{}_{}", task.job, task.index)});
}

}  // namespace adit
