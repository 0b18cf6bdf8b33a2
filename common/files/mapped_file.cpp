// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/mapped_file.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw FileError(path.string() + ": " + std::generic_category().message(error));
}

std::span<const std::uint8_t> map(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0) throw std::system_error(errno, std::generic_category());
  if (S_ISDIR(status.st_mode)) throw std::system_error(EISDIR, std::generic_category());
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return {};
  void* const start = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (start == MAP_FAILED) throw std::system_error(errno, std::generic_category());
  return {static_cast<const std::uint8_t*>(start), size};
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, errno);
  try {
    bytes_ = map(file);
    close(file);
  } catch (const std::system_error& error) {
    close(file);
    fail(path, error.code().value());
  }
}

void MappedFile::release(std::size_t from, std::size_t to) const {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t start = (from + page - 1) / page * page;
  const std::size_t end = std::min(to, bytes_.size()) / page * page;
  if (start >= end) return;
  madvise(const_cast<std::uint8_t*>(bytes_.data()) + start, end - start, MADV_DONTNEED);
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) munmap(const_cast<std::uint8_t*>(bytes_.data()), bytes_.size());
}

}  // namespace adit
