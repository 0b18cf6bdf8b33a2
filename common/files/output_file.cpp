// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/output_file.hpp"

#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

constexpr int kClosed = -1;
constexpr mode_t kMode = 0666;  // less the umask

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, std::filesystem::path name)
    : name_(std::move(name)),
      file_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode)) {
  if (file_ < 0) fail(errno);
}

OutputFile::~OutputFile() {
  if (file_ != kClosed) ::close(file_);
}

void OutputFile::write(std::string_view bytes) {
  const std::uint64_t end = bytes_ + bytes.size();
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int error = written < 0 ? errno : ENOSPC;
      if (ftruncate(file_, static_cast<off_t>(bytes_)) == 0) {
        lseek(file_, static_cast<off_t>(bytes_), SEEK_SET);
      }
      fail(error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  bytes_ = end;
}

void OutputFile::close() {
  // Linux closes the descriptor also if it reports an error, EINTR included.
  if (file_ != kClosed && ::close(std::exchange(file_, kClosed)) != 0 && errno != EINTR)
    fail(errno);
}

void OutputFile::fail(int error) const {
  throw FileError(name_.string() + ": cannot write: " + std::generic_category().message(error));
}

}  // namespace adit
