// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace adit {

/// What a read of 0 bytes means: the end of the connection (TCP), or, of a terminal, nothing unless
/// it was hung up.
enum class EndOfData { kIsEnd, kIsHangUp };

/// Reads what a descriptor that does not block has, 0 bytes if nothing. Nothing if the connection
/// is lost.
std::optional<std::size_t> read_available(int descriptor, std::span<std::uint8_t> bytes,
                                          EndOfData end_of_data);

/// Writes what fits. False if the connection is lost.
bool write_available(int descriptor, std::span<const std::uint8_t> bytes);

}  // namespace adit
