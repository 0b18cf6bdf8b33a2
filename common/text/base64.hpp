// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace adit {

/// Bytes in Base64 with padding (RFC 4648, section 4).
std::string base64(std::span<const std::uint8_t> bytes);

/// The bytes of what `base64` returns; nothing of any other text.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace adit
