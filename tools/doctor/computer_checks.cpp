// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/doctor/computer_checks.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <sys/timex.h>
#include <unistd.h>

#include "common/bus/lcm_transport.hpp"
#include "common/bus/node/stages.hpp"
#include "common/config/config_file.hpp"
#include "common/files/file_error.hpp"
#include "common/files/file_utils.hpp"
#include "common/files/temporary_file.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

constexpr std::int64_t kReleasedUtime = 1'735'689'600'000'000;  // 2025-01-01
constexpr double kDiskReserve = 4.0;   // of the speed; other processes write, too
constexpr double kMissionHours = 8.0;  // for which the space of the disk should suffice
constexpr double kLoadShareMax = 0.6;  // of a core; the rest is for transport and drivers
constexpr int kBlocks = 64;            // of 1 MB each
constexpr double kUsPerS = 1e6;

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

ClockState read_clock() {
  timex state{};
  const int result = adjtimex(&state);
  ClockState clock;
  clock.synchronized = result != TIME_ERROR && (state.status & STA_UNSYNC) == 0;
  clock.error_max_s = static_cast<double>(state.maxerror) / kUsPerS;
  clock.utime = std::chrono::duration_cast<std::chrono::microseconds>(
                    std::chrono::system_clock::now().time_since_epoch())
                    .count();
  return clock;
}

std::vector<std::string> read_governors() {
  std::vector<std::string> governors;
  for (int cpu = 0;; ++cpu) {
    const std::filesystem::path folder = fmt::format("/sys/devices/system/cpu/cpu{}", cpu);
    if (!std::filesystem::exists(folder)) return governors;
    std::ifstream file(folder / "cpufreq/scaling_governor");
    if (std::string name; file >> name) governors.push_back(name);
  }
}

}  // namespace

CheckResult check_route(const std::string& proc_net_route) {
  if (has_multicast_route(proc_net_route))
    return {Verdict::kGood, "route", "multicast (224.0.0.0/4) has a route"};
  return {Verdict::kBad, "route",
          "multicast has no route, no message arrives: one computer, sudo systemctl enable --now "
          "adit-loopback; two computers, see Network in README.md of deploy"};
}

CheckResult check_buffers(std::int64_t rmem_max) {
  if (rmem_max < 0)
    return {Verdict::kUnknown, "buffers", "/proc/sys/net/core/rmem_max cannot be read"};
  const std::string text =
      fmt::format("net.core.rmem_max = {}, needed {}", rmem_max, kReceiveBufferBytes);
  if (rmem_max >= kReceiveBufferBytes) return {Verdict::kGood, "buffers", text};
  return {Verdict::kBad, "buffers",
          text + fmt::format(": large messages are lost; sudo sysctl -w net.core.rmem_max={}, "
                             "permanently with sysctl/60-adit-lcm.conf of deploy",
                             kReceiveBufferBytes)};
}

CheckResult check_clock(const ClockState& clock) {
  if (clock.utime < kReleasedUtime) {
    return {Verdict::kBad, "clock",
            "the date is before 2025: everything that is recorded carries it; set it (timedatectl "
            "set-time), and replace the battery of the clock"};
  }
  if (!clock.synchronized) {
    return {Verdict::kUnknown, "clock",
            "not synchronized: enough for one computer without a network; for two use chrony, see "
            "Time in README.md of deploy"};
  }
  return {Verdict::kGood, "clock", fmt::format("synchronized, within {:.3f} s", clock.error_max_s)};
}

CheckResult check_governors(const std::vector<std::string>& governors) {
  if (governors.empty())
    return {Verdict::kUnknown, "governor", "the kernel does not scale the frequency here"};
  std::map<std::string, int> counts;
  for (const std::string& governor : governors) ++counts[governor];
  std::string text;
  for (const auto& [governor, count] : counts)
    text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", count, message_line(governor));
  if (!counts.contains("powersave")) return {Verdict::kGood, "governor", text};
  return {Verdict::kBad, "governor",
          text +
              ": the processor may stay slow while stages wait for it; sudo cpupower "
              "frequency-set -g performance (with intel_pstate, powersave is right if the load "
              "below is)"};
}

CheckResult check_disk(const std::filesystem::path& folder, double write_mb_s, double free_mb,
                       double log_mb_s) {
  const double hours = free_mb / log_mb_s / 3600.0;
  const std::string text =
      fmt::format("{}: {:.0f} MB/s, the log needs {:.2f}; {:.0f} MB free are {:.1f} h",
                  message_line(folder.string()), write_mb_s, log_mb_s, free_mb, hours);
  if (write_mb_s < kDiskReserve * log_mb_s) {
    return {Verdict::kBad, "disk",
            text + ": too slow, journals would wait for it; record on another disk, or less often"};
  }
  if (hours < kMissionHours) {
    return {Verdict::kBad, "disk",
            text +
                ": move earlier logs away; the recording deletes its oldest parts, and below 500 "
                "MB it stops"};
  }
  return {Verdict::kGood, "disk", text};
}

CheckResult check_device(const std::string& driver, const std::string& device) {
  const std::string text = fmt::format("{}: {}", driver, message_line(device));
  if (device.starts_with("tcp://"))
    return {Verdict::kUnknown, "device", text + " is on the network, not tried"};
  if (access(device.c_str(), F_OK) != 0) {
    return {Verdict::kBad, "device",
            text + " does not exist: is it plugged in? ls -l /dev/serial/by-id names what is"};
  }
  if (access(device.c_str(), R_OK | W_OK) != 0) {
    return {Verdict::kBad, "device",
            text +
                " may not be opened by this user: sudo usermod -aG dialout USER and log in "
                "again; the service runs as adit, which is in that group"};
  }
  return {Verdict::kGood, "device", text + " may be opened"};
}

CheckResult check_load(const StageLoad& load, unsigned cores) {
  const std::string text = fmt::format(
      "all stages at the sensors' rates: {:.2f} of one core on average, {:.2f} in the worst "
      "second, "
      "over {:.0f} s; {} cores",
      load.share, load.share_max, load.simulated_s, cores);
  if (load.share > kLoadShareMax * cores) {
    return {Verdict::kBad, "load",
            text +
                ": too slow, stages would miss scans; a faster computer, two of them (deploy), or "
                "fewer scans per second"};
  }
  if (load.share_max > cores) {
    return {Verdict::kBad, "load",
            text +
                ": too slow at times, commands would expire after 0.25 s; a faster computer, or "
                "fewer beams"};
  }
  return {Verdict::kGood, "load", text};
}

CheckResults check_computer(const std::filesystem::path& config) {
  CheckResults results;
  results.push_back(check_route(contents("/proc/net/route")));
  std::int64_t rmem_max = -1;
  std::ifstream("/proc/sys/net/core/rmem_max") >> rmem_max;
  results.push_back(check_buffers(rmem_max));
  results.push_back(check_clock(read_clock()));
  results.push_back(check_governors(read_governors()));
  if (config.empty()) return results;
  const ConfigFile file = ConfigFile::load(find_installed_file(config, "config"));
  for (const std::string& section : driver_sections()) {
    const ConfigNode* const node = file.section(section);
    const ConfigNode* const device = node == nullptr ? nullptr : node->find("device");
    if (device != nullptr) results.push_back(check_device(section, device->text));
  }
  return results;
}

double disk_speed_mb_s(const std::filesystem::path& folder) {
  const TemporaryFile file(folder);
  const std::string block(1'000'000, '\x5a');
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kBlocks; ++i) {
    for (std::size_t written = 0; written < block.size();) {
      const ssize_t bytes =
          write(file.descriptor(), block.data() + written, block.size() - written);
      if (bytes <= 0) throw FileError("cannot write to the disk of " + folder.string());
      written += static_cast<std::size_t>(bytes);
    }
  }
  if (fsync(file.descriptor()) != 0)
    throw FileError("cannot write to the disk of " + folder.string());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  return kBlocks / std::max(1e-3, seconds.count());
}

}  // namespace adit
