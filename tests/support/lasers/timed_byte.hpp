// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// A byte on a line, and when its last bit arrives [µs].
struct TimedByte {
  std::int64_t utime = 0;
  std::uint8_t byte = 0;
};

}  // namespace adit
