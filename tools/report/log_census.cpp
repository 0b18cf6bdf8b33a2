// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/log_census.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/log_parser.hpp"
#include "common/bus/stages.hpp"
#include "common/files/mapped_file.hpp"
#include "common/messages/codec.hpp"

namespace adit {
namespace {

void note_config(const LogEventView& event, LogCensus& census) {
  const auto message = decode<config_t>(event.data);
  if (!message) return;
  if (const auto copy = from_message(*message)) census.configs[copy->stage] = *copy;
}

void note(const LogEventView& event, LogCensus& census) {
  const auto known = census.messages.find(event.channel);
  if (known == census.messages.end()) {
    census.messages.emplace(event.channel, 1);
  } else {
    ++known->second;
  }
  if (event.channel == channels::kConfig) note_config(event, census);
  census.last_utime = std::max(census.last_utime, event.utime);
  if (census.first_utime == 0) census.first_utime = event.utime;
  census.first_utime = std::min(census.first_utime, event.utime);
}

void complain(const LogHealth& health, const std::string& file, LogCensus& census) {
  if (health.corrupt_bytes > 0) {
    census.complaints.push_back(std::string("skipped ") + std::to_string(health.corrupt_bytes) +
                                " corrupt bytes of " + file);
  }
  if (health.truncated_bytes > 0) {
    census.complaints.push_back(file + " is cut off in the middle of an event");
  }
  if (health.events == 0) census.complaints.push_back("no event in " + file);
}

std::optional<Lasers> lasers_of(const ConfigCopy& copy) {
  try {
    const ConfigFile config = ConfigFile::parse(copy.yaml, "CONFIG of " + copy.stage);
    if (config.section(Lasers::kSection) == nullptr) return std::nullopt;
    return load_section<Lasers>(config, Lasers::kSection);
  } catch (const ConfigError&) {
    return std::nullopt;
  }
}

}  // namespace

bool LogCensus::simulated() const {
  return has(channels::kTruth) || has(channels::kRunState) || configs.contains(kSimSection);
}

Lasers LogCensus::lasers() const {
  for (const auto& [stage, copy] : configs) {
    if (const auto lasers = lasers_of(copy)) return *lasers;
  }
  return {};
}

LogCensus take_census(const std::vector<std::filesystem::path>& logs) {
  LogCensus census;
  for (const auto& path : logs) {
    const MappedFile file(path);
    LogParser parser(file.bytes());
    while (const auto event = parser.next()) note(*event, census);
    complain(parser.health(), path.filename().string(), census);
  }
  if (census.messages.empty()) {
    throw std::runtime_error("no event in " + (logs.empty() ? "no log" : logs.front().string()));
  }
  return census;
}

}  // namespace adit
