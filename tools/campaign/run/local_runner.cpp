// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/run/local_runner.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <thread>

#include <poll.h>

#include "common/service/wall_time.hpp"
#include "tools/campaign/run/unit_process.hpp"

namespace adit {
namespace {

/// A unit can exceed its memory limit by what it allocates in this time.
constexpr std::int64_t kMemoryPeriodUs = 250'000;

using Units = std::vector<std::unique_ptr<UnitProcess>>;

/// Waits for the end of a unit, for a signal or for `until_us`.
void wait(const Units& active, int stop_descriptor, std::int64_t until_us) {
  for (const auto& unit : active) {
    if (unit->descriptor() < 0) return;  // not started: has its result
    until_us = std::min(until_us, unit->deadline_us());
  }
  std::vector<pollfd> descriptors{{stop_descriptor, POLLIN, 0}};
  for (const auto& unit : active) descriptors.push_back({unit->descriptor(), POLLIN, 0});
  const std::int64_t wait_us = std::max<std::int64_t>(until_us - steady_us(), 0);
  poll(descriptors.data(), descriptors.size(), static_cast<int>(wait_us / 1000) + 1);
}

bool is_readable(int descriptor) {
  pollfd poll_descriptor{descriptor, POLLIN, 0};
  return descriptor >= 0 && poll(&poll_descriptor, 1, 0) > 0;
}

/// Reports the units that have ended, and removes them. Returns whether to continue.
bool collect(Units& active, const LocalRunner::OnResult& on_result) {
  bool continues = true;
  std::erase_if(active, [&](const auto& unit) {
    const auto result = unit->poll();
    if (result && continues) continues = on_result(unit->unit(), *result);
    return result.has_value();
  });
  return continues;
}

}  // namespace

int LocalRunner::jobs_for(int cores_of_unit) {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / cores_of_unit);
}

bool LocalRunner::run(const CampaignPlan& plan, const std::vector<const CampaignUnit*>& units,
                      const CampaignFolder& folder, const OnResult& on_result) const {
  Units active;
  std::int64_t memory_us = steady_us() + kMemoryPeriodUs;
  auto next = units.begin();
  while (next != units.end() || !active.empty()) {
    if (is_readable(stop_descriptor)) return false;
    for (; next != units.end() && static_cast<int>(active.size()) < jobs; ++next)
      active.push_back(std::make_unique<UnitProcess>(plan, **next, folder, watcher));
    wait(active, stop_descriptor, memory_us);
    if (steady_us() >= memory_us) {
      for (const auto& unit : active) unit->check_memory();
      memory_us = steady_us() + kMemoryPeriodUs;
    }
    if (!collect(active, on_result)) return true;
  }
  return true;
}

}  // namespace adit
