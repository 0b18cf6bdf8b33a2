// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/codec.hpp"

namespace adit {

std::int64_t fingerprint(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes.first<8>()) value = value << 8 | byte;
  return static_cast<std::int64_t>(value);
}

}  // namespace adit
