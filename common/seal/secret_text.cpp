// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/seal/secret_text.hpp"

#include <array>
#include <stdexcept>

#include <sodium.h>

namespace adit {

std::string random_secret() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
  std::array<unsigned char, 16> bytes{};
  std::array<char, 2 * bytes.size() + 1> digits{};
  randombytes_buf(bytes.data(), bytes.size());
  return sodium_bin2hex(digits.data(), digits.size(), bytes.data(), bytes.size());
}

bool secrets_are_equal(std::string_view a, std::string_view b) {
  return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace adit
