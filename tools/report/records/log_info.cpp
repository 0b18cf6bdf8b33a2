// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/log_info.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/node/stages.hpp"
#include "common/messages/codec.hpp"

namespace adit {
namespace {

void add_config(const LogEventView& event, LogInfo& log_info) {
  const auto message = decode<config_t>(event.data);
  if (!message) return;
  if (const auto config = from_message(*message)) log_info.configs[config->stage] = *config;
}

void add_event(const LogEventView& event, LogInfo& log_info) {
  ++log_info.messages[std::string(event.channel)];
  if (event.channel == channels::kConfig) add_config(event, log_info);
  log_info.last_utime = std::max(log_info.last_utime, event.utime);
  if (log_info.first_utime == 0) log_info.first_utime = event.utime;
  log_info.first_utime = std::min(log_info.first_utime, event.utime);
}

void add_warnings(const LogHealth& health, const std::string& file, LogInfo& log_info) {
  for (std::string& warning : damage_warnings(health, file))
    log_info.warnings.push_back(std::move(warning));
  if (health.events == 0) log_info.warnings.push_back(fmt::format("no events in {}", file));
}

void add_lasers(LogInfo& log_info) {
  for (const auto& [stage, config] : log_info.configs) {
    const auto lasers = recorded_section<Lasers>(config, Lasers::kSection, log_info.warnings);
    if (!lasers) continue;
    log_info.lasers = *lasers;
    return;
  }
}

}  // namespace

bool LogInfo::simulated() const {
  return has(channels::kTruth) || has(channels::kRunState) || configs.contains(kSimSection);
}

LogInfo read_log_info(const std::vector<std::filesystem::path>& logs) {
  LogInfo log_info;
  for (const auto& path : logs) {
    LogReader reader(path);
    while (const auto event = reader.next()) add_event(*event, log_info);
    add_warnings(reader.health(), path.filename().string(), log_info);
  }
  if (log_info.messages.empty()) {
    throw std::runtime_error(
        fmt::format("no events in {}", logs.empty() ? "no log" : logs.front().string()));
  }
  add_lasers(log_info);
  return log_info;
}

}  // namespace adit
