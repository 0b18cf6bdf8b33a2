// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/rotated_file.hpp"

#include <cerrno>
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
  trouble_.clear();
}

bool RotatedFile::open() {
  if (file_) return true;
  file_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kMode));
  struct stat info {};
  if (!file_ || fstat(file_.get(), &info) != 0) return fail();
  bytes_ = info.st_size;
  return true;
}

void RotatedFile::rotate() {
  file_.reset();
  std::error_code ignored;  // one that is not there, or cannot be moved: then this one grows on
  std::filesystem::remove(numbered(path_, limits_.files - 1), ignored);
  for (int i = limits_.files - 1; i > 0; --i) {
    std::filesystem::rename(numbered(path_, i - 1), numbered(path_, i), ignored);
  }
}

bool RotatedFile::fail() {
  trouble_ = path_.string() + ": " + std::generic_category().message(errno);
  file_.reset();
  return false;
}

}  // namespace adit
