// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/host_meter.hpp"

#include <cstdint>
#include <fstream>
#include <map>
#include <utility>

namespace adit {
namespace {

/// "MemTotal:  8048404 kB" and so on, in bytes.
std::map<std::string, std::int64_t> read_meminfo(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::map<std::string, std::int64_t> bytes;
  std::string name;
  std::string unit;
  std::int64_t number = 0;
  while (file >> name >> number && std::getline(file, unit)) bytes[name] = number * 1024;
  return bytes;
}

struct Ticks {
  double busy = 0.0;
  double all = 0.0;
};

/// "cpu  user nice system idle iowait irq softirq steal ..", since the start of the computer.
Ticks read_ticks(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string name;
  file >> name;
  Ticks ticks;
  double number = 0.0;
  for (int i = 0; i < 8 && file >> number; ++i) {
    const bool idle = i == 3 || i == 4;
    ticks.all += number;
    if (!idle) ticks.busy += number;
  }
  return ticks;
}

}  // namespace

HostLoad HostMeter::measure() {
  auto memory = read_meminfo(proc_ / "meminfo");
  HostLoad load{0.0, memory["MemTotal:"], memory["MemAvailable:"], memory["SwapTotal:"],
                memory["SwapFree:"]};
  const Ticks ticks = read_ticks(proc_ / "stat");
  const double busy = ticks.busy - std::exchange(busy_ticks_, ticks.busy);
  const double all = ticks.all - std::exchange(all_ticks_, ticks.all);
  if (all > 0.0 && busy > 0.0) load.cpu_share = busy / all;
  return load;
}

}  // namespace adit
