// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_live.hpp"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sched.h>

#include "common/bus/lcm_bus.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/files/disk_space.hpp"
#include "common/files/locked_file.hpp"
#include "common/sensing/seconds.hpp"
#include "common/service/wall_time.hpp"
#include "procs/supervisor/control/control_client.hpp"
#include "procs/supervisor/os/child_process.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_monitor.hpp"
#include "tools/mission/private_network.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr auto kPollPeriod = std::chrono::milliseconds(20);
constexpr auto kStopMax = std::chrono::seconds(40);  // the simulator waits for the stages
constexpr std::size_t kOutputBytesMax = 256 * 1024;

/// What a program of this project needs to run under adit-watch.
ChildStart child_start(const std::vector<std::string>& arguments) {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  ChildStart start;
  start.line.arguments = arguments;
  start.line.arguments.front() = (folder / arguments.front()).string();
  start.stop_signal = SIGTERM;
  start.stop_time_s = 5.0;
  start.watcher = folder / "adit-watch";
  return start;
}

/// The folder of this program comes first in PATH, so that its stages are started.
ChildStart supervisor_start(const fs::path& config) {
  ChildStart start = child_start({"adit-supervisor", "--sim-time", "--config", config.string()});
  std::string path = start.watcher.parent_path().string();
  if (const char* const others = std::getenv("PATH")) path.append(":").append(others);
  start.line.environment = {{"PATH", path}};
  return start;
}

/// The process of adit-supervisor, from the folder of this program, in the working folder. Its
/// heartbeats use simulated time, as the guard requires. The process and its children end with this
/// object or this process, in any case.
class SupervisorProgram {
 public:
  /// Appends its output to the file `log`. Throws std::runtime_error if it cannot be started.
  SupervisorProgram(const fs::path& config, const fs::path& log);

  /// Exit status as text; nothing while it runs. Does not block.
  std::optional<std::string> ended();

  /// Stops it and its processes. Blocks.
  void stop();

 private:
  std::ofstream log_;
  ChildProcess child_;
  std::optional<std::string> end_;
};

SupervisorProgram::SupervisorProgram(const fs::path& config, const fs::path& log)
    : log_(log, std::ios::app), child_(supervisor_start(config)) {}

std::optional<std::string> SupervisorProgram::ended() {
  log_ << child_.read_output(kOutputBytesMax) << std::flush;
  if (const auto end = child_.poll()) end_ = end->text();
  return end_;
}

void SupervisorProgram::stop() {
  if (ended()) return;
  kill(child_.pid(), SIGTERM);  // not the group: the supervisor stops the others in order
  const auto until = std::chrono::steady_clock::now() + kStopMax;
  while (!ended() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(kPollPeriod);
}

/// The process of adit-viewer, which serves the mission on a socket of another network. It is
/// started again if it ends, a few times.
class ViewerProgram {
 public:
  ViewerProgram(int socket, std::string title, const fs::path& log)
      : socket_(socket), title_(std::move(title)), log_(log, std::ios::app) {}

  /// Starts it if it does not run. Returns why it does not any more, once.
  std::optional<std::string> keep_running() try {
    if (child_) {
      log_ << child_->read_output(kOutputBytesMax) << std::flush;
      const auto end = child_->poll();
      if (!end) return std::nullopt;
      child_.reset();
      if (starts_ == kStartsMax) return "adit-viewer " + end->text() + "; see viewer.log";
    }
    if (starts_ == kStartsMax) return std::nullopt;
    ++starts_;
    ChildStart start = child_start({"adit-viewer", "--title", title_});
    start.listening_socket = socket_;
    child_.emplace(start);
    return std::nullopt;
  } catch (const std::runtime_error& error) {
    starts_ = kStartsMax;
    return fmt::format("no live view: adit-viewer {}", error.what());
  }

 private:
  static constexpr int kStartsMax = 5;

  int socket_;
  std::string title_;
  std::ofstream log_;
  std::optional<ChildProcess> child_;
  int starts_ = 0;
};

constexpr const char* kPrivateUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr std::int64_t kProgressPeriodUs = 500'000;  // of wall time
constexpr std::int64_t kStallTimeoutUs = 60'000'000;
constexpr int kPollMs = 50;
constexpr double kFullMb = 1.0;                     // less is a full disk
constexpr std::uint64_t kReservationTested = 4096;  // bytes

/// Other programs join the network of this process by its id.
void write_pid(const LockedFile& file) {
  const std::string text = fmt::format("{}\n", getpid());
  file.truncate(0);
  file.write_at(0, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

/// At maximum speed, the default scheduler preempts the sender of a message for each receiver,
/// which costs more than the work itself. Children inherit the policy. At a fixed speed it would
/// only add latency.
void use_batch_scheduling(const std::string& speed) {
  const sched_param none{};
  if (speed == "max") sched_setscheduler(0, SCHED_BATCH, &none);  // optional: errors are ignored
}

class LiveMission {
 public:
  LiveMission(const MissionLiveOptions& options, const MissionFolder& folder,
              const MissionStart& start, const std::function<void(const std::string&)>& notify)
      : options_(options),
        folder_(folder),
        notify_(notify),
        bus_({.url = {}, .time = BusTime::kSimulated}),
        monitor_(bus_, folder.path() / "phases.tsv", start),
        supervisor_("supervisor.yaml", folder.path() / "supervisor.log") {
    if (options.view_socket)
      viewer_.emplace(*options.view_socket, folder.path().filename().string(),
                      folder.path() / "viewer.log");
  }

  MissionLiveResult run(const StopSignal& stop, const MissionLiveProgress& progress) {
    const std::int64_t begin_us = steady_us();
    std::int64_t progress_us = begin_us;
    MissionLiveResult result;
    while (result.abort_reason.empty() && !monitor_.has_ended()) {
      handle_messages();
      const std::int64_t now_us = steady_us();
      result.abort_reason = abort_reason(stop, now_us);
      restart_timed_out_stages(now_us);
      report_not_stored();
      if (viewer_) {
        if (const auto failure = viewer_->keep_running()) notify_(*failure);
      }
      if (now_us < progress_us + kProgressPeriodUs) continue;
      progress_us = now_us;
      if (progress) progress(monitor_.progress(), seconds(now_us - begin_us));
    }
    result.wall_s = seconds(steady_us() - begin_us);
    if (monitor_.has_ended() && monitor_.scans_to_store() > 0)
      notify_(fmt::format("3D scans not in the volume map: {}; scan_assembly.journal has them",
                          monitor_.scans_to_store()));
    result.interrupted = stop.received();
    supervisor_.stop();
    result.trace_failure = monitor_.trace_failure();
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
    if (stop.received()) return "interrupted; continue with adit mission --resume";
    if (!monitor_.failure().empty())
      return fmt::format("simulation failed: {}", monitor_.failure());
    if (monitor_.progress().simulated_s > options_.time_max_s) return "time limit reached";
    if (const auto end = supervisor_.ended())
      return fmt::format("adit-supervisor {}; see supervisor.log", *end);
    if (std::exchange(utime_, monitor_.utime()) != monitor_.utime() || advanced_us_ == 0) {
      advanced_us_ = now_us;
    }
    if (now_us < advanced_us_ + kStallTimeoutUs) return {};
    const std::string shortage = DiskSpace(folder_.path(), kFullMb).shortage();
    if (!shortage.empty()) return "simulated time has stopped, the disk is full: " + shortage;
    return "simulated time has stopped; see supervisor.log";
  }

  void report_not_stored() {
    const std::vector<std::string> lines = monitor_.progress().not_stored;
    for (; reported_ < lines.size(); ++reported_) notify_(lines[reported_]);
  }

  /// The supervisor cannot detect this: while one stage hangs, simulated time stops, and no stage
  /// sends heartbeats.
  void restart_timed_out_stages(std::int64_t now_us) {
    for (const std::string& stage : monitor_.newly_timed_out(now_us)) {
      notify_(fmt::format("{} does not respond: restarting it", stage));
      request_from_supervisor(folder_.socket(), {"restart", stage});
    }
  }

  const MissionLiveOptions& options_;
  const MissionFolder& folder_;
  const std::function<void(const std::string&)>& notify_;
  LcmBus bus_;
  MissionMonitor monitor_;
  SupervisorProgram supervisor_;
  std::optional<ViewerProgram> viewer_;
  std::size_t reported_ = 0;  // lines on what is not stored
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
    notify("no private network available (unshare): other LCM programs receive this mission");
  }
  const MissionFolder folder(options.folder);
  const LockedFile lock_file(folder.lock_file());
  write_pid(lock_file);
  if (lock_file.reserve(0, kReservationTested) == LockedFile::Reservation::kNotSupported) {
    notify("the file system of " + folder.path().string() +
           " cannot reserve space for the journals: records may not fit once it is full");
  }
  const MissionStart start = prepare_mission(options, folder);
  std::filesystem::current_path(folder.path());
  LiveMission mission(options, folder, start, notify);
  return mission.run(stop, progress);
}

}  // namespace adit
