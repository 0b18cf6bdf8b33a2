// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace adit {

/// Bytes in a page itself, RFC 2397: "data:image/png;base64,…".
std::string data_uri(const std::string& media_type, std::span<const std::uint8_t> bytes);

}  // namespace adit
