// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/log_info.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/node/stages.hpp"
#include "common/files/mapped_file.hpp"
#include "common/messages/codec.hpp"

namespace adit {
namespace {

void add_config(const LogEventView& event, LogInfo& log_info) {
  const auto message = decode<config_t>(event.data);
  if (!message) return;
  if (const auto copy = from_message(*message)) log_info.configs[copy->stage] = *copy;
}

void add_event(const LogEventView& event, LogInfo& log_info) {
  const auto known = log_info.messages.find(event.channel);
  if (known == log_info.messages.end()) {
    log_info.messages.emplace(event.channel, 1);
  } else {
    ++known->second;
  }
  if (event.channel == channels::kConfig) add_config(event, log_info);
  log_info.last_utime = std::max(log_info.last_utime, event.utime);
  if (log_info.first_utime == 0) log_info.first_utime = event.utime;
  log_info.first_utime = std::min(log_info.first_utime, event.utime);
}

void add_warnings(const LogHealth& health, const std::string& file, LogInfo& log_info) {
  if (health.corrupt_bytes > 0) {
    log_info.warnings.push_back(std::string("skipped ") + std::to_string(health.corrupt_bytes) +
                                " corrupt bytes of " + file);
  }
  if (health.truncated_bytes > 0) {
    log_info.warnings.push_back(file + " is cut off in the middle of an event");
  }
  if (health.events == 0) log_info.warnings.push_back("no event in " + file);
}

std::optional<Lasers> lasers_of(const ConfigSnapshot& copy) {
  try {
    const ConfigFile config = ConfigFile::parse(copy.yaml, "CONFIG of " + copy.stage);
    if (config.section(Lasers::kSection) == nullptr) return std::nullopt;
    return load_section<Lasers>(config, Lasers::kSection);
  } catch (const ConfigError&) {
    return std::nullopt;
  }
}

}  // namespace

bool LogInfo::simulated() const {
  return has(channels::kTruth) || has(channels::kRunState) || configs.contains(kSimSection);
}

Lasers LogInfo::lasers() const {
  for (const auto& [stage, copy] : configs) {
    if (const auto lasers = lasers_of(copy)) return *lasers;
  }
  return {};
}

LogInfo read_log_info(const std::vector<std::filesystem::path>& logs) {
  LogInfo log_info;
  for (const auto& path : logs) {
    const MappedFile file(path);
    LogParser parser(file.bytes());
    while (const auto event = parser.next()) add_event(*event, log_info);
    add_warnings(parser.health(), path.filename().string(), log_info);
  }
  if (log_info.messages.empty()) {
    throw std::runtime_error("no event in " + (logs.empty() ? "no log" : logs.front().string()));
  }
  return log_info;
}

}  // namespace adit
