// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_live.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include <sched.h>

#include "common/bus/lcm_bus.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/files/locked_file.hpp"
#include "common/sensing/seconds.hpp"
#include "procs/supervisor/control/control_client.hpp"
#include "procs/supervisor/os/child_process.hpp"
#include "tools/mission/mission_files.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_monitor.hpp"
#include "tools/mission/private_network.hpp"

namespace adit {
namespace {

/// An adit-supervisor, of the folder where this program is, that runs in the working folder and
/// shows life by simulated time, as the guard wants it. Neither it nor anything that it started
/// outlives this object or this process, however that ends.
class SupervisorProgram {
 public:
  /// What it prints is added to the file `log`. Throws std::runtime_error where it cannot be
  /// started.
  SupervisorProgram(const std::filesystem::path& config, const std::filesystem::path& log);

  /// How it ended, if it did, without waiting.
  std::optional<std::string> ended();

  /// Lets it stop its processes, and waits for that.
  void stop();

 private:
  std::ofstream log_;
  ChildProcess child_;
  std::optional<std::string> end_;
};

namespace fs = std::filesystem;

constexpr auto kPollPeriod = std::chrono::milliseconds(20);
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
  while (!ended() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(kPollPeriod);
}

constexpr const char* kPrivateUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr std::int64_t kProgressPeriodUs = 500'000;  // of wall time
constexpr std::int64_t kStallTimeoutUs = 60'000'000;
constexpr int kPollMs = 50;

std::int64_t wall_us() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// Tells others, which may want to look or to give an order, on whose network it is.
void write_pid(const LockedFile& file) {
  const std::string text = std::to_string(getpid()) + "\n";
  file.truncate(0);
  file.write_at(0, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

/// As fast as it goes, each message would otherwise make the kernel take the processor from who
/// sent it for each of those who wait for it, which is more work than what they do. Those that are
/// started later inherit it; at a speed of its own it would cost punctuality for nothing.
void use_batch_scheduling(const std::string& speed) {
  const sched_param none{};
  if (speed == "max") sched_setscheduler(0, SCHED_BATCH, &none);  // no harm where it is refused
}

class LiveMission {
 public:
  LiveMission(const MissionLiveOptions& options, const MissionFolder& folder,
              const Eigen::Vector2d& p_world_start,
              const std::function<void(const std::string&)>& notify)
      : options_(options),
        folder_(folder),
        notify_(notify),
        bus_({.url = {}, .time = BusTime::kSimulated}),
        monitor_(bus_, folder.path() / "phases.tsv", p_world_start),
        supervisor_("supervisor.yaml", folder.path() / "supervisor.log") {}

  MissionLiveResult run(const StopSignal& stop, const MissionLiveProgress& progress) {
    const std::int64_t begin_us = wall_us();
    std::int64_t progress_us = begin_us;
    MissionLiveResult result;
    while (result.abort_reason.empty() && !monitor_.has_ended()) {
      handle_messages();
      const std::int64_t now_us = wall_us();
      result.abort_reason = abort_reason(stop, now_us);
      restart_timed_out_stages(now_us);
      if (now_us < progress_us + kProgressPeriodUs) continue;
      progress_us = now_us;
      if (progress) progress(monitor_.progress(), seconds(now_us - begin_us));
    }
    result.wall_s = seconds(wall_us() - begin_us);
    result.interrupted = stop.received();
    supervisor_.stop();
    result.last = monitor_.progress();
    result.farthest_m = monitor_.farthest_m();
    return result;
  }

 private:
  void handle_messages() {
    if (!bus_.handle(kPollMs)) return;
    while (bus_.handle(0)) {
    }
  }

  std::string abort_reason(const StopSignal& stop, std::int64_t now_us) {
    if (stop.received()) return "it was interrupted; adit mission --resume goes on";
    if (!monitor_.failure().empty()) return "the run has failed: " + monitor_.failure();
    if (monitor_.progress().simulated_s > options_.time_max_s) return "its time is up";
    if (const auto end = supervisor_.ended())
      return "adit-supervisor " + *end + "; see supervisor.log";
    if (std::exchange(utime_, monitor_.utime()) != monitor_.utime() || advanced_us_ == 0) {
      advanced_us_ = now_us;
    }
    if (now_us < advanced_us_ + kStallTimeoutUs) return {};
    return "simulated time stands still; see supervisor.log";
  }

  /// The supervisor cannot know: while one stage is suspended, all wait for it and say nothing.
  void restart_timed_out_stages(std::int64_t now_us) {
    for (const std::string& stage : monitor_.newly_timed_out(now_us)) {
      notify_(stage + " does not answer, and is started again");
      request_from_supervisor(folder_.socket(), {"restart", stage});
    }
  }

  const MissionLiveOptions& options_;
  const MissionFolder& folder_;
  const std::function<void(const std::string&)>& notify_;
  LcmBus bus_;
  MissionMonitor monitor_;
  SupervisorProgram supervisor_;
  std::int64_t utime_ = 0;
  std::int64_t advanced_us_ = 0;  // wall time
};

}  // namespace

MissionLiveResult run_live_mission(const MissionLiveOptions& options,
                                   const MissionLiveProgress& progress,
                                   const std::function<void(const std::string&)>& notify) {
  const StopSignal stop;
  use_batch_scheduling(options.speed);
  if (enter_private_network()) {
    setenv("LCM_DEFAULT_URL", kPrivateUrl, 1);
  } else {
    notify(
        "no network of its own can be had here (unshare): other programs on LCM hear this mission");
  }
  const MissionFolder folder(options.folder);
  const LockedFile lock_file(folder.lock_file());
  write_pid(lock_file);
  const Eigen::Vector2d p_world_start = prepare_mission(options, folder);
  std::filesystem::current_path(folder.path());
  LiveMission mission(options, folder, p_world_start, notify);
  return mission.run(stop, progress);
}

}  // namespace adit
