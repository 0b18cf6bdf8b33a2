// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/seal/seal_key.hpp"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

namespace adit {
namespace {

constexpr std::string_view kContext = "adit seal 1";  // other uses of one key give other tags
constexpr mode_t kForbidden = S_IWGRP | S_IRWXO;

/// Throws std::runtime_error if the generator of the kernel does not work.
void require_sodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), reason));
}

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return value_; }

 private:
  int value_;
};

}  // namespace

SealKey SealKey::random() {
  require_sodium();
  SealKey key;
  randombytes_buf(key.bytes_.data(), key.bytes_.size());
  return key;
}

SealKey SealKey::read(const std::filesystem::path& path) {
  require_sodium();
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0) fail(path, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) fail(path, "not a file with a key");
  if ((status.st_mode & kForbidden) != 0) {
    fail(path, "others may read or change this key, try: chmod 640, or 600");
  }
  std::array<char, 66> text{};
  const ssize_t size = ::read(file.get(), text.data(), text.size());
  SealKey key;
  std::size_t used = 0;
  const bool is_line = size == 64 || (size == 65 && text[64] == '\n');
  if (!is_line ||
      sodium_hex2bin(key.bytes_.data(), key.bytes_.size(), text.data(), 64, nullptr, &used,
                     nullptr) != 0 ||
      used != key.bytes_.size()) {
    fail(path, "a key is one line of 64 hexadecimal digits, as adit key --new writes it");
  }
  return key;
}

namespace {

/// False with the reason in errno.
bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

void SealKey::write_new(const std::filesystem::path& path) const {
  const Descriptor file(
      open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (file.get() < 0) fail(path, std::strerror(errno));
  std::array<char, 65> text{};
  sodium_bin2hex(text.data(), text.size(), bytes_.data(), bytes_.size());
  text[64] = '\n';
  const bool is_written =
      write_all(file.get(), {text.data(), text.size()}) && fsync(file.get()) == 0;
  if (is_written) return;
  const int reason = errno;
  unlink(path.c_str());
  fail(path, std::strerror(reason));
}

SealNonce SealKey::tag(std::string_view channel, const SealTrailer& seal,
                       std::span<const std::uint8_t> message) const {
  // The length of all parts but the last is fixed or precedes it: no two inputs give the same
  // bytes.
  const auto length = static_cast<std::uint8_t>(channel.size());
  const auto sequence = big_endian(seal.sequence);
  SealNonce tag{};
  crypto_generichash_state state;
  const auto add = [&state](const void* data, std::size_t size) {
    crypto_generichash_update(&state, static_cast<const unsigned char*>(data), size);
  };
  crypto_generichash_init(&state, bytes_.data(), bytes_.size(), tag.size());
  add(kContext.data(), kContext.size());
  add(&length, 1);
  add(channel.data(), channel.size());
  add(seal.session.data(), seal.session.size());
  add(sequence.data(), sequence.size());
  add(message.data(), message.size());
  crypto_generichash_final(&state, tag.data(), tag.size());
  return tag;
}

bool SealKey::matches(std::string_view channel, const SealedBytes& sealed) const {
  const SealNonce expected = tag(channel, sealed.seal, sealed.message);
  return sodium_memcmp(expected.data(), sealed.seal.tag.data(), expected.size()) == 0;
}

SealNonce random_nonce() {
  require_sodium();
  SealNonce nonce{};
  randombytes_buf(nonce.data(), nonce.size());
  return nonce;
}

}  // namespace adit
