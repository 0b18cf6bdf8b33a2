// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct z_stream_s;

namespace adit {

/// Reads a file, plain or compressed with gzip (RFC 1952, also of several members). Returns all
/// that can be decompressed, and then states what is lost; zlib's gzread drops the last chunk
/// before an error and takes a damaged member for the end of the file.
class GzipFile {
 public:
  /// This and `read` throw FileError if the file cannot be opened or the disk cannot read it.
  explicit GzipFile(const std::filesystem::path& path);
  ~GzipFile();
  GzipFile(GzipFile&&) noexcept;
  GzipFile& operator=(GzipFile&&) noexcept;

  /// Fills the beginning of `out` with the next bytes; returns their number, 0 at the end.
  std::size_t read(std::span<char> out);

  /// What is lost, after the end: "the last 512 of 4096 bytes of the compressed file, .."; empty if
  /// the file is intact.
  [[nodiscard]] const std::string& damage() const { return damage_; }
  /// Fraction of the file that has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const;

 private:
  struct End {
    void operator()(z_stream_s* stream) const;
  };

  bool fill();
  bool begin_member();
  std::size_t inflate_into(std::span<char> out);
  void fail();
  [[nodiscard]] std::size_t bytes_used() const;

  std::filesystem::path path_;
  std::ifstream file_;
  std::size_t size_bytes_ = 0;
  std::size_t bytes_read_ = 0;
  std::vector<char> input_;
  std::size_t input_at_ = 0;                 // of the first byte that is not used
  std::unique_ptr<z_stream_s, End> stream_;  // null for a plain file
  bool in_member_ = false;
  bool ended_ = false;
  std::string damage_;
};

}  // namespace adit
