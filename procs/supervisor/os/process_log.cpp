// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/process_log.hpp"

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace adit {
namespace {

constexpr mode_t kMode = 0644;

std::filesystem::path numbered(std::filesystem::path path, int number) {
  if (number > 0) (path += '.') += std::to_string(number);
  return path;
}

}  // namespace

void RotatedFile::write(std::string_view text) {
  if (!open()) return;
  if (bytes_ > 0 && bytes_ + static_cast<std::int64_t>(text.size()) > limits_.bytes_max) {
    rotate();
    if (!open()) return;
  }
  while (!text.empty()) {
    const ssize_t n = ::write(file_.get(), text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      fail();
      return;
    }
    bytes_ += n;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  error_.clear();
}

bool RotatedFile::open() {
  if (file_) return true;
  file_ = FileDescriptor(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kMode));
  struct stat info {};
  if (!file_ || fstat(file_.get(), &info) != 0) return fail();
  bytes_ = info.st_size;
  return true;
}

void RotatedFile::rotate() {
  file_.reset();
  std::error_code ignored;  // if a file cannot be moved, the current one keeps growing
  std::filesystem::remove(numbered(path_, limits_.files - 1), ignored);
  for (int i = limits_.files - 1; i > 0; --i) {
    std::filesystem::rename(numbered(path_, i - 1), numbered(path_, i), ignored);
  }
}

bool RotatedFile::fail() {
  error_ = path_.string() + ": " + std::generic_category().message(errno);
  file_.reset();
  return false;
}

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
