// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/recorded_lasers.hpp"

#include "common/bus/channels.hpp"
#include "common/config/config.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/config_copy.hpp"

namespace adit {
namespace {

std::optional<Lasers> lasers_of(const LogEventView& event) {
  const auto message = decode<config_t>(event.data);
  if (!message) return std::nullopt;
  const auto copy = from_message(*message);
  if (!copy) return std::nullopt;
  const ConfigFile config = ConfigFile::parse(copy->yaml, "CONFIG of " + copy->stage);
  if (config.section(Lasers::kSection) == nullptr) return std::nullopt;
  return load_section<Lasers>(config, Lasers::kSection);
}

}  // namespace

std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events) {
  for (const LogEventView& event : events) {
    if (event.channel != channels::kConfig) continue;
    if (const auto lasers = lasers_of(event)) return lasers;
  }
  return std::nullopt;
}

}  // namespace adit
