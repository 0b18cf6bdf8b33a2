// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/seal/seal_trailer.hpp"

namespace adit {

/// The secret that the robot and its operators share, 256 bits. In a file it is a line of 64
/// hexadecimal digits.
class SealKey {
 public:
  static SealKey random();

  /// Throws std::runtime_error with the path if the file does not hold a key, or if users other
  /// than its owner and its group may read or write it, or its group may write it.
  static SealKey read(const std::filesystem::path& path);

  /// Creates the file, readable by its owner alone. Throws std::runtime_error with the path if it
  /// exists or cannot be written.
  void write_new(const std::filesystem::path& path) const;

  /// Keyed BLAKE2b (RFC 7693) over the channel, session and sequence of `seal`, and the message.
  [[nodiscard]] SealNonce tag(std::string_view channel, const SealTrailer& seal,
                              std::span<const std::uint8_t> message) const;

  /// Whether the tag of the seal is the right one, in a time that does not depend on the tag.
  [[nodiscard]] bool matches(std::string_view channel, const SealedBytes& sealed) const;

 private:
  std::array<std::uint8_t, 32> bytes_{};
};

/// From the random generator of the kernel.
SealNonce random_nonce();

}  // namespace adit
