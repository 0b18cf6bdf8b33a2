// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/new_file.hpp"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

/// The file that a link points to keeps its place.
fs::path target_of(const fs::path& path) {
  std::error_code dangling;
  if (!fs::is_symlink(path, dangling)) return path;
  const fs::path target = fs::canonical(path, dangling);
  return dangling ? path : target;
}

bool is_device(const fs::path& path) {
  std::error_code missing;
  const fs::file_status status = fs::status(path, missing);
  return fs::exists(status) && !fs::is_regular_file(status);
}

fs::path part_of(const fs::path& path) {
  std::string name = ".";
  name.append(path.filename().string()).append(".").append(std::to_string(getpid()));
  return path.parent_path() / name.append(".part");
}

/// Delayed errors of the disk appear here, before the name promises the content.
int sync(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = fsync(file) != 0 ? errno : 0;
  return close(file) != 0 && error == 0 ? errno : error;
}

}  // namespace

NewFile::NewFile(const fs::path& path)
    : path_(target_of(path)), part_(is_device(path_) ? path_ : part_of(path_)) {}

NewFile::~NewFile() {
  std::error_code ignored;
  if (!published_ && part_ != path_) fs::remove(part_, ignored);
}

void NewFile::publish() {
  std::error_code error;
  if (part_ != path_) {
    if (fs::exists(path_, error)) fs::permissions(part_, fs::status(path_).permissions(), error);
    error.assign(sync(part_), std::generic_category());
    if (!error) fs::rename(part_, path_, error);
  }
  if (error) throw FileError("cannot write " + path_.string() + ": " + error.message());
  published_ = true;
}

}  // namespace adit
