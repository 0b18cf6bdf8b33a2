// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/temporary_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

int create_in(const std::filesystem::path& folder) {
  std::string name = folder / ".adit-unpacked.XXXXXX";
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) unlink(name.c_str());
  return file;
}

}  // namespace

TemporaryFile::TemporaryFile(const std::filesystem::path& folder) : file_(create_in(folder)) {
  if (file_ >= 0) return;
  const std::filesystem::path other = std::filesystem::temp_directory_path();
  file_ = create_in(other);
  if (file_ < 0) {
    throw FileError("cannot create a file in " + other.string() + ": " +
                    std::generic_category().message(errno));
  }
}

TemporaryFile::~TemporaryFile() { close(file_); }

std::filesystem::path TemporaryFile::path() const {
  return "/proc/self/fd/" + std::to_string(file_);
}

}  // namespace adit
