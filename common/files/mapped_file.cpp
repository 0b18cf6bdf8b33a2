// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/mapped_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <memory>
#include <mutex>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/files/file_error.hpp"

namespace adit {

/// The pages of a mapped file, for the signal handler: `begin` is 0 in a place that is free.
struct detail::Mapping {
  std::atomic<std::uintptr_t> begin;
  std::atomic<std::uintptr_t> end;
  std::unique_ptr<std::atomic<bool>[]> unreadable;  // NOLINT(modernize-avoid-c-arrays)
  std::atomic<std::size_t> unreadable_pages;
};

namespace {

using detail::Mapping;

constexpr std::size_t kMappingsMax = 4096;
constexpr std::uintptr_t kTaken = 1;  // begin of a place that is being filled

std::array<Mapping, kMappingsMax> mappings;
struct sigaction previous_action {};

std::size_t page_bytes() {
  static const auto bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return bytes;
}

/// A page that cannot be read becomes one of zeros. Only calls of the kernel and atomic accesses.
void on_bus_error(int signal, siginfo_t* info, void* context) {
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  for (Mapping& mapping : mappings) {
    const std::uintptr_t begin = mapping.begin;
    if (begin <= kTaken || address < begin || address >= mapping.end) continue;
    const std::size_t page = (address - begin) / page_bytes();
    void* const start = reinterpret_cast<void*>(begin + page * page_bytes());  // NOLINT
    constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED;
    if (mmap(start, page_bytes(), PROT_READ, kFlags, -1, 0) == MAP_FAILED) break;
    if (!mapping.unreadable[page].exchange(true)) ++mapping.unreadable_pages;
    return;
  }
  if ((previous_action.sa_flags & SA_SIGINFO) != 0) {
    previous_action.sa_sigaction(signal, info, context);
  } else {
    sigaction(SIGBUS, &previous_action, nullptr);  // the access is repeated
    if (info->si_code <= 0) raise(signal);         // sent by a process, not repeated
  }
}

void handle_bus_errors() {
  static std::once_flag once;
  std::call_once(once, [] {
    page_bytes();
    struct sigaction action {};
    action.sa_sigaction = on_bus_error;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGBUS, &action, &previous_action);
  });
}

Mapping* add_mapping(std::span<const std::uint8_t> bytes) {
  handle_bus_errors();
  for (Mapping& mapping : mappings) {
    std::uintptr_t free = 0;
    if (!mapping.begin.compare_exchange_strong(free, kTaken)) continue;
    const std::size_t pages = (bytes.size() + page_bytes() - 1) / page_bytes();
    mapping.unreadable = std::make_unique<std::atomic<bool>[]>(pages);  // NOLINT
    mapping.unreadable_pages = 0;
    const auto begin = reinterpret_cast<std::uintptr_t>(bytes.data());
    mapping.end = begin + pages * page_bytes();
    mapping.begin = begin;
    return &mapping;
  }
  throw std::system_error(EMFILE, std::generic_category());
}

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

void unmap(std::span<const std::uint8_t> bytes) {
  munmap(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) : path_(path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, errno);
  try {
    bytes_ = map(file);
    if (!bytes_.empty()) mapping_ = add_mapping(bytes_);
    close(file);
  } catch (const std::system_error& error) {
    if (!bytes_.empty()) unmap(bytes_);
    close(file);
    fail(path, error.code().value());
  }
}

void MappedFile::release(std::size_t from, std::size_t to) const {
  const std::size_t start = (from + page_bytes() - 1) / page_bytes() * page_bytes();
  const std::size_t end = std::min(to, bytes_.size()) / page_bytes() * page_bytes();
  if (start >= end) return;
  madvise(const_cast<std::uint8_t*>(bytes_.data()) + start, end - start, MADV_DONTNEED);
}

bool MappedFile::is_readable(std::span<const std::uint8_t> part) const {
  if (part.empty()) return true;
  const auto offset = static_cast<std::size_t>(part.data() - bytes_.data());
  const std::size_t last = (offset + part.size() - 1) / page_bytes();
  for (std::size_t page = offset / page_bytes(); page <= last; ++page) {
    // The access is what reads the page.
    [[maybe_unused]] const volatile std::uint8_t read = bytes_[page * page_bytes()];
  }
  if (mapping_->unreadable_pages == 0) return true;
  const auto* const unreadable = mapping_->unreadable.get();
  return std::none_of(unreadable + offset / page_bytes(), unreadable + last + 1,
                      [](const std::atomic<bool>& page) { return page.load(); });
}

std::size_t MappedFile::unreadable_bytes() const {
  return mapping_ ? std::min(mapping_->unreadable_pages * page_bytes(), bytes_.size()) : 0;
}

void MappedFile::require_readable() const {
  if (const std::size_t bytes = unreadable_bytes(); bytes > 0) {
    throw FileError(fmt::format("{}: the disk cannot read {} of its {} bytes", path_.string(),
                                bytes, bytes_.size()));
  }
}

MappedFile::~MappedFile() {
  if (!mapping_) return;
  unmap(bytes_);
  mapping_->end = 0;
  mapping_->unreadable.reset();
  mapping_->begin = 0;
}

}  // namespace adit
