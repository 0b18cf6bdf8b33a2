// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/file_utils.hpp"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <system_error>

#include <unistd.h>

#include "common/files/file_error.hpp"
#include "common/files/gzip_file.hpp"
#include "common/files/new_file.hpp"
#include "common/files/output_file.hpp"

namespace adit {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 18;

FileError too_large(const fs::path& path, std::size_t bytes_max) {
  return FileError(path.string() + ": larger than " + std::to_string(bytes_max) + " bytes");
}

/// Reads by `read_chunk(bytes, count)`, which returns the number of bytes read, 0 at the end.
template <class ReadChunk>
std::string read_all(const fs::path& path, std::size_t bytes_max, const ReadChunk& read_chunk) {
  std::string text;
  for (std::size_t got = 1; got > 0;) {
    const std::size_t size = text.size();
    text.resize(size + kChunkBytes);
    got = read_chunk(text.data() + size, kChunkBytes);
    text.resize(size + got);
    if (text.size() > bytes_max) throw too_large(path, bytes_max);
  }
  return text;
}

}  // namespace

std::string read_text_file(const fs::path& path, std::size_t bytes_max) {
  std::error_code error;
  std::ifstream file;
  if (!fs::is_directory(path, error)) file.open(path, std::ios::binary);
  if (!file.is_open()) throw FileError("cannot read " + path.string());
  return read_all(path, bytes_max, [&](char* bytes, std::size_t count) {
    file.read(bytes, static_cast<std::streamsize>(count));
    if (file.bad()) throw FileError("cannot read " + path.string());
    return static_cast<std::size_t>(file.gcount());
  });
}

std::string read_gzip_file(const fs::path& path, std::size_t bytes_max) {
  GzipFile file(path);
  std::string text = read_all(path, bytes_max, [&](char* bytes, std::size_t count) {
    return file.read({bytes, count});
  });
  if (!file.damage().empty()) {
    throw FileError(path.string() + ": the compressed file is corrupt");
  }
  return text;
}

void write_text_file(std::string_view text, const fs::path& path) {
  NewFile file(path);
  OutputFile out(file.part(), path);
  out.write(text);
  out.close();
  file.publish();
}

std::optional<fs::path> installed_file(const std::string& folder, const fs::path& name) {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path share = program.parent_path().parent_path() / "share" / "adit";
  const fs::path installed = share / folder / name;
  return fs::exists(installed, ignored) ? std::optional(installed) : std::nullopt;
}

fs::path find_installed_file(const fs::path& path, const std::string& folder) {
  std::error_code ignored;
  if (path.empty() || path.is_absolute() || fs::exists(path, ignored)) return path;
  return installed_file(folder, path.filename()).value_or(path);
}

void finish_standard_output() {
  const bool complete = std::cout.flush().good() && std::fflush(stdout) == 0;
  const int copy = dup(STDOUT_FILENO);  // network file systems report errors when closing
  if (!complete || (copy >= 0 && close(copy) != 0)) {
    throw FileError("cannot write to standard output");
  }
}

}  // namespace adit
