// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace adit {

/// What Marc Lehmann's LZF has packed (the compression within PCD files), if it comes to exactly
/// `size` bytes; nothing otherwise. Nothing is allocated for a size that so few bytes cannot hold.
std::optional<std::vector<std::uint8_t>> unpack_lzf(std::span<const std::uint8_t> packed,
                                                    std::size_t size);

}  // namespace adit
