// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/supervisor_program.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr auto kLook = std::chrono::milliseconds(20);
constexpr auto kStopMax = std::chrono::seconds(40);  // the simulator hears the stages out
constexpr std::size_t kOutputBytesMax = 256 * 1024;

/// With the programs that belong to this one before all others.
ChildStart start_of(const fs::path& config) {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  std::string path = folder.string();
  if (const char* const others = std::getenv("PATH")) path.append(":").append(others);
  ChildStart start;
  start.line.environment = {{"PATH", path}};
  start.line.arguments = {(folder / "adit-supervisor").string(), "--sim-time", "--config",
                          config.string()};
  start.stop_signal = SIGTERM;
  start.stop_time_s = 5.0;
  start.watcher = folder / "adit-watch";
  return start;
}

}  // namespace

SupervisorProgram::SupervisorProgram(const fs::path& config, const fs::path& log)
    : log_(log, std::ios::app), child_(start_of(config)) {}

std::optional<std::string> SupervisorProgram::ended() {
  log_ << child_.read_output(kOutputBytesMax) << std::flush;
  if (const auto end = child_.poll()) end_ = end->text();
  return end_;
}

void SupervisorProgram::stop() {
  if (ended()) return;
  kill(child_.pid(), SIGTERM);  // it alone: it knows in which order the others are to go
  const auto until = std::chrono::steady_clock::now() + kStopMax;
  while (!ended() && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(kLook);
}

}  // namespace adit
