// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/log_input.hpp"

#include <array>
#include <fstream>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/config/config.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "tools/carmen/carmen_import.hpp"

namespace adit {
namespace {

/// An LCM log begins with the sync word of its first event.
bool is_lcm_log(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  constexpr std::array<unsigned char, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
  std::array<char, 4> head{};
  file.read(head.data(), head.size());
  for (std::size_t i = 0; i < kSync.size(); ++i) {
    if (static_cast<unsigned char>(head[i]) != kSync[i]) return false;
  }
  return true;
}

std::vector<std::string> log_warnings(const LogHealth& health) {
  std::vector<std::string> found;
  if (health.corrupt_bytes > 0) {
    found.push_back(std::to_string(health.corrupt_bytes) + " corrupt bytes in " +
                    std::to_string(health.corrupt_regions) + " places");
  }
  if (health.truncated_bytes > 0) {
    found.push_back("the last event, which the end of the file cuts off");
  }
  return found;
}

}  // namespace

LogInput::LogInput(const std::filesystem::path& path, const std::filesystem::path& scratch,
                   const std::function<void(double)>& progress) {
  if (is_lcm_log(path) || path.extension() == ".lcmlog") {
    log_ = std::make_unique<LogFile>(path);
    warnings_ = log_warnings(log_->health());
  } else {
    warnings_ = import_carmen(path, scratch, progress).messages();
    log_ = std::make_unique<LogFile>(scratch);
    std::filesystem::remove(scratch);  // what is open stays readable
  }
}

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
