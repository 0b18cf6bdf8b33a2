// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/usage_meter.hpp"

#include <utility>

namespace adit {

ProcessUse UsageMeter::measure(const ProcessTable& table, pid_t ancestor, std::int64_t now_us) {
  const std::map<pid_t, double> before = std::exchange(cpu_s_, {});
  ProcessUse use;
  double busy_s = 0.0;
  for (const pid_t pid : table.descendants_of(ancestor)) {
    const ProcessEntry& entry = table.entries().at(pid);
    use.address_bytes += entry.address_bytes;
    use.memory_bytes += entry.memory_bytes;
    if (entry.state == 'D') use.waits_for_disk = true;
    const auto known = before.find(pid);
    busy_s += entry.cpu_s - (known == before.end() ? 0.0 : known->second);
    cpu_s_[pid] = entry.cpu_s;
  }
  const auto last_us = std::exchange(last_us_, now_us);
  if (last_us && now_us > *last_us && busy_s > 0.0) {
    use.cpu_cores = busy_s / (static_cast<double>(now_us - *last_us) * 1e-6);
  }
  return use;
}

}  // namespace adit
