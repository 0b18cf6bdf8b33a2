// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct crypto_hash_sha256_state;

namespace adit {

/// SHA-256 (FIPS 180-4) of bytes that arrive in parts, as sha256sum prints it.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  /// 64 hexadecimal digits. Nothing may be added afterwards.
  std::string hex();

 private:
  std::unique_ptr<crypto_hash_sha256_state> state_;
};

/// The same of a text.
std::string sha256_hex(std::string_view text);

/// The same of the content of a file of any size. Throws FileError.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace adit
