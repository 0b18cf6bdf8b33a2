// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// Converts a difference of two utimes [µs] to seconds.
constexpr double seconds(std::int64_t microseconds) {
  return 1e-6 * static_cast<double>(microseconds);
}

}  // namespace adit
