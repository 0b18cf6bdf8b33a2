// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

/// LCM's event log: events one after the other, each a header, the channel, the data. Numbers are
/// big-endian. Header: sync word, event number (8), time [µs] (8), length of the channel, length of
/// the data (4 each).
namespace adit::log_format {

inline constexpr std::uint32_t kSync = 0xEDA1DA01;
inline constexpr std::size_t kHeaderBytes = 28;
inline constexpr std::size_t kLongestChannel = 63;

}  // namespace adit::log_format
