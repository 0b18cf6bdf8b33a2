// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/replay_logs.hpp"

#include <cstddef>
#include <utility>

#include "common/bus/log/event_source.hpp"

namespace adit {
namespace {

constexpr std::size_t kEventsPerProgress = 10'000;

}  // namespace

std::vector<std::string> replay_logs(const std::vector<std::filesystem::path>& logs,
                                     const std::function<void(double)>& progress,
                                     const std::function<void(const LogEventView&)>& play) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    LogFile log(logs[i]);
    std::size_t events = 0;
    while (const auto event = log.next()) {
      play(*event);
      if (++events % kEventsPerProgress != 0) continue;
      const double share = static_cast<double>(events) / static_cast<double>(log.size());
      progress((static_cast<double>(i) + share) / static_cast<double>(logs.size()));
    }
    for (std::string& warning : damage_warnings(log.health(), logs[i].filename().string()))
      warnings.push_back(std::move(warning));
  }
  return warnings;
}

}  // namespace adit
