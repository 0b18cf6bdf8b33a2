// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/process_log.hpp"

#include <array>
#include <cctype>
#include <cstdio>
#include <ctime>

namespace adit {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::int64_t kMillisecondUs = 1'000;

std::string file_name(const std::string& id) {
  std::string name;
  for (const char c : id) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte < 0x80 && (std::isalnum(byte) || c == '_' || c == '-');
    std::array<char, 4> code{};
    std::snprintf(code.data(), code.size(), "%%%02X", byte);
    name += plain ? std::string(1, c) : std::string(code.data());
  }
  return name + ".log";
}

}  // namespace

std::string utc_text(std::int64_t utime) {
  const std::time_t seconds = utime / kSecondUs;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text.data() + size, text.size() - size, ".%03dZ",
                static_cast<int>(utime % kSecondUs / kMillisecondUs));
  return text.data();
}

ProcessLog::ProcessLog(const std::filesystem::path& folder, const std::string& id,
                       const RotatedFile::Limits& limits) {
  if (!folder.empty()) file_.emplace(folder / file_name(id), limits);
}

void ProcessLog::add(std::string_view line, std::int64_t utime) {
  if (!file_) return;
  waiting_.append(utc_text(utime)).append(" ").append(line).append("\n");
}

void ProcessLog::flush() {
  if (waiting_.empty()) return;
  file_->write(waiting_);
  waiting_.clear();
}

}  // namespace adit
