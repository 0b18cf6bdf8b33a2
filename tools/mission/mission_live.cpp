// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_live.hpp"

#include <chrono>
#include <cstdlib>
#include <span>
#include <utility>

#include <sched.h>

#include "common/bus/lcm_bus.hpp"
#include "common/bus/stop_signal.hpp"
#include "common/files/locked_file.hpp"
#include "common/sensing/seconds.hpp"
#include "procs/supervisor/terminal/terminal_client.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_preparation.hpp"
#include "tools/mission/mission_watch.hpp"
#include "tools/mission/private_network.hpp"
#include "tools/mission/supervisor_program.hpp"

namespace adit {
namespace {

constexpr const char* kPrivateUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr std::int64_t kTellUs = 500'000;  // of wall time
constexpr std::int64_t kSilenceMaxUs = 60'000'000;
constexpr int kListenMs = 50;

std::int64_t wall_us() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// Tells others, which may want to look or to give an order, on whose network it is.
void announce(const LockedFile& file) {
  const std::string text = std::to_string(getpid()) + "\n";
  file.truncate(0);
  file.write_at(0, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

/// As fast as it goes, each message would otherwise make the kernel take the processor from who
/// sent it for each of those who wait for it, which is more work than what they do. Those that are
/// started later inherit it; at a speed of its own it would cost punctuality for nothing.
void run_in_batches(const std::string& speed) {
  const sched_param none{};
  if (speed == "max") sched_setscheduler(0, SCHED_BATCH, &none);  // no harm where it is refused
}

class LiveMission {
 public:
  LiveMission(const MissionLiveOptions& options, const MissionFolder& folder,
              const Eigen::Vector2d& p_world_start,
              const std::function<void(const std::string&)>& say)
      : options_(options),
        folder_(folder),
        say_(say),
        bus_({.url = {}, .time = BusTime::kSimulated}),
        watch_(bus_, folder.path() / "phases.tsv", p_world_start),
        supervisor_("supervisor.yaml", folder.path() / "supervisor.log") {}

  MissionLiveResult run(const StopSignal& stop, const MissionLiveProgress& progress) {
    const std::int64_t begin_us = wall_us();
    std::int64_t told_us = begin_us;
    MissionLiveResult result;
    while (result.trouble.empty() && !watch_.has_ended()) {
      listen();
      const std::int64_t now_us = wall_us();
      result.trouble = trouble(stop, now_us);
      wake_silent(now_us);
      if (now_us < told_us + kTellUs) continue;
      told_us = now_us;
      if (progress) progress(watch_.progress(), seconds(now_us - begin_us));
    }
    result.wall_s = seconds(wall_us() - begin_us);
    result.interrupted = stop.came();
    supervisor_.stop();
    result.last = watch_.progress();
    result.farthest_m = watch_.farthest_m();
    return result;
  }

 private:
  void listen() {
    if (!bus_.handle(kListenMs)) return;
    while (bus_.handle(0)) {
    }
  }

  std::string trouble(const StopSignal& stop, std::int64_t now_us) {
    if (stop.came()) return "it was interrupted; adit mission --resume goes on";
    if (!watch_.failure().empty()) return "the run has failed: " + watch_.failure();
    if (watch_.progress().simulated_s > options_.time_max_s) return "its time is up";
    if (const auto end = supervisor_.ended())
      return "adit-supervisor " + *end + "; see supervisor.log";
    if (std::exchange(utime_, watch_.utime()) != watch_.utime() || moved_us_ == 0) {
      moved_us_ = now_us;
    }
    if (now_us < moved_us_ + kSilenceMaxUs) return {};
    return "simulated time stands still; see supervisor.log";
  }

  /// The supervisor cannot know: while one stage is suspended, all wait for it and say nothing.
  void wake_silent(std::int64_t now_us) {
    for (const std::string& stage : watch_.newly_silent(now_us)) {
      say_(stage + " does not answer, and is started again");
      ask_supervisor(folder_.socket(), {"restart", stage});
    }
  }

  const MissionLiveOptions& options_;
  const MissionFolder& folder_;
  const std::function<void(const std::string&)>& say_;
  LcmBus bus_;
  MissionWatch watch_;
  SupervisorProgram supervisor_;
  std::int64_t utime_ = 0;
  std::int64_t moved_us_ = 0;  // wall time
};

}  // namespace

MissionLiveResult run_live_mission(const MissionLiveOptions& options,
                                   const MissionLiveProgress& progress,
                                   const std::function<void(const std::string&)>& say) {
  const StopSignal stop;
  run_in_batches(options.speed);
  if (enter_private_network()) {
    setenv("LCM_DEFAULT_URL", kPrivateUrl, 1);
  } else {
    say("no network of its own can be had here (unshare): other programs on LCM hear this mission");
  }
  const MissionFolder folder(options.folder);
  const LockedFile running(folder.running());
  announce(running);
  const Eigen::Vector2d p_world_start = prepare_mission(options, folder);
  std::filesystem::current_path(folder.path());
  LiveMission mission(options, folder, p_world_start, say);
  return mission.run(stop, progress);
}

}  // namespace adit
