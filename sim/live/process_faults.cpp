// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/process_faults.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "common/config/number_text.hpp"
#include "sim/live/sim_config.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr pid_t kInit = 1;
constexpr const char* kWatcher = "adit-watch";  // parent of each process, child of the supervisor

/// Parses `pid (name) state ppid ..`, where the name may contain any character.
std::optional<pid_t> parent_of(const fs::path& folder) {
  std::ifstream file(folder / "stat");
  std::string stat;
  std::getline(file, stat, '\0');  // the complete file; fails if the process has ended
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos || name_end + 4 >= stat.size()) return std::nullopt;
  const std::size_t begin = name_end + 4;  // behind ") S "
  return parse_number<pid_t>(stat.substr(begin, stat.find(' ', begin) - begin));
}

std::map<pid_t, pid_t> all_parents() {
  std::map<pid_t, pid_t> parents;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const auto pid = parse_number<pid_t>(entry.path().filename().string());
    if (!pid) continue;
    if (const auto parent = parent_of(entry.path())) parents[*pid] = *parent;
  }
  return parents;
}

bool descends(pid_t pid, pid_t ancestor, const std::map<pid_t, pid_t>& parents) {
  // At most as many steps as processes: the table is not a snapshot and may contain a cycle.
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const auto found = parents.find(pid);
    if (found == parents.end()) return false;
    if (found->second == ancestor) return true;
    pid = found->second;
  }
  return false;
}

std::string executable_of(pid_t pid) {
  std::error_code unknown;
  return fs::read_symlink(fs::path("/proc") / std::to_string(pid) / "exe", unknown)
      .filename()
      .string();
}

}  // namespace

std::vector<pid_t> descendants_named(pid_t ancestor, const std::string& executable) {
  const std::map<pid_t, pid_t> parents = all_parents();
  std::vector<pid_t> found;
  for (const auto& [pid, parent] : parents) {
    if (descends(pid, ancestor, parents) && executable_of(pid) == executable) found.push_back(pid);
  }
  return found;
}

pid_t launcher_of(pid_t pid) {
  do {
    pid = parent_of(fs::path("/proc") / std::to_string(pid)).value_or(0);
  } while (pid > kInit && executable_of(pid) == kWatcher);
  return pid;
}

int signal_siblings(const std::string& executable, int signal) {
  const pid_t starter = launcher_of(getpid());
  if (starter <= kInit) return 0;
  const std::vector<pid_t> pids = descendants_named(starter, executable);
  return static_cast<int>(
      std::ranges::count_if(pids, [&](pid_t pid) { return kill(pid, signal) == 0; }));
}

namespace {

std::string apply_fault(const FaultDescription& fault) {
  const std::string executable = fmt::format("adit-{}", fault.target);
  const int sent = signal_siblings(executable, fault.kind == "kill" ? SIGKILL : SIGSTOP);
  const std::string result = sent == 0
                                 ? "no such process was started beside this program"
                                 : fmt::format("{} {}", sent, sent == 1 ? "process" : "processes");
  return fmt::format("{} {}: {}", fault.kind, executable, result);
}

}  // namespace

ProcessFaults::ProcessFaults(const std::vector<FaultDescription>& faults) {
  std::ranges::copy_if(faults, std::back_inserter(faults_), is_process_fault);
  std::ranges::stable_sort(faults_, {}, &FaultDescription::at_s);
}

std::vector<ProcessFaults::AppliedFault> ProcessFaults::advance(double elapsed_s) {
  std::vector<AppliedFault> done;
  for (; next_ < faults_.size() && faults_[next_].at_s <= elapsed_s; ++next_) {
    done.push_back({faults_[next_].target, apply_fault(faults_[next_])});
  }
  return done;
}

}  // namespace adit
