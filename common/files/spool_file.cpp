// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/spool_file.hpp"

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include <unistd.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

[[noreturn]] void fail(const std::filesystem::path& folder, const char* what, int error) {
  throw FileError(folder.string() + ": cannot " + what +
                  " a temporary file: " + std::generic_category().message(error));
}

}  // namespace

std::uint64_t SpoolFile::append(std::span<const std::uint8_t> bytes) {
  if (!block_.empty() && block_.size() + bytes.size() > kBlockBytes) store_block();
  const std::uint64_t offset = size();
  block_.insert(block_.end(), bytes.begin(), bytes.end());
  return offset;
}

void SpoolFile::store_block() {
  if (!file_) file_ = std::make_unique<TemporaryFile>(folder_);
  for (std::size_t done = 0; done < block_.size();) {
    const ssize_t written = pwrite(file_->descriptor(), block_.data() + done, block_.size() - done,
                                   static_cast<off_t>(stored_ + done));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(folder_, "write", written < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(written);
  }
  stored_ += block_.size();
  block_.clear();
}

void SpoolFile::read(std::uint64_t offset, std::span<std::uint8_t> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size() && offset + done < stored_) {
    const std::size_t part =
        static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), stored_ - offset)) - done;
    const ssize_t got =
        pread(file_->descriptor(), bytes.data() + done, part, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail(folder_, "read", got < 0 ? errno : EIO);
    done += static_cast<std::size_t>(got);
  }
  if (done == bytes.size()) return;
  const auto from = block_.begin() + static_cast<std::ptrdiff_t>(offset + done - stored_);
  std::copy_n(from, bytes.size() - done, bytes.begin() + static_cast<std::ptrdiff_t>(done));
}

void SpoolFile::truncate(std::uint64_t offset) {
  if (offset >= stored_) {
    block_.resize(static_cast<std::size_t>(offset - stored_));
    return;
  }
  block_.clear();
  stored_ = offset;  // the next block replaces what is behind
}

}  // namespace adit
