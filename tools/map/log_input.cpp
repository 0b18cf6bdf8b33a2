// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/log_input.hpp"

#include <array>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/messages/codec.hpp"
#include "tools/carmen/carmen_import.hpp"

namespace adit {
namespace {

std::vector<std::string> log_warnings(const LogHealth& health) {
  std::vector<std::string> warnings;
  if (health.corrupt_bytes > 0) {
    warnings.push_back(fmt::format("{} corrupt bytes in {} regions", health.corrupt_bytes,
                                   health.corrupt_regions));
  }
  if (health.truncated_bytes > 0) warnings.emplace_back("the last event, which is truncated");
  return warnings;
}

}  // namespace

bool is_lcm_log(const std::filesystem::path& file) {
  if (file.extension() == ".lcmlog") return true;
  std::ifstream stream(file, std::ios::binary);
  constexpr std::array<unsigned char, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
  for (const unsigned char byte : kSync) {
    if (stream.get() != byte) return false;
  }
  return true;
}

LogInput::LogInput(const std::filesystem::path& path, const std::filesystem::path& scratch,
                   const std::function<void(double)>& progress) {
  if (!std::ifstream(path)) throw std::runtime_error(fmt::format("cannot read {}", path.string()));
  if (is_lcm_log(path)) {
    log_ = std::make_unique<LogFile>(path);
    warnings_ = log_warnings(log_->health());
  } else {
    warnings_ = import_carmen(path, scratch, progress).messages();
    log_ = std::make_unique<LogFile>(scratch);
    std::filesystem::remove(scratch);  // the open file stays readable
  }
}

std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events,
                                      std::vector<std::string>& warnings) {
  for (const LogEventView& event : events) {
    if (event.channel != channels::kConfig) continue;
    const auto message = decode<config_t>(event.data);
    if (!message) continue;
    const auto snapshot = from_message(*message);
    if (!snapshot) continue;
    if (auto lasers = recorded_section<Lasers>(*snapshot, Lasers::kSection, warnings)) {
      return lasers;
    }
  }
  return std::nullopt;
}

}  // namespace adit
