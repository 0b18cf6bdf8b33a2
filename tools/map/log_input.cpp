// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/log_input.hpp"

#include <array>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/carmen/carmen_import.hpp"

namespace adit {
namespace {

/// An LCM log starts with the sync word of its first event.
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
  std::vector<std::string> warnings;
  if (health.corrupt_bytes > 0) {
    warnings.push_back(fmt::format("{} corrupt bytes in {} regions", health.corrupt_bytes,
                                   health.corrupt_regions));
  }
  if (health.truncated_bytes > 0) warnings.emplace_back("the last event, which is truncated");
  return warnings;
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
    std::filesystem::remove(scratch);  // the open file stays readable
  }
}

}  // namespace adit
