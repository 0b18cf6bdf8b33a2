// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// What adit-watch and who started it tell each other over two lines. To adit-watch: single bytes,
/// the number of a signal for all that it watches over; SIGKILL means that nothing is to be left.
/// From it: reports, in the byte order of the machine; and its end, once nothing is left.
struct WatchReport {
  enum class Kind : std::int32_t {
    kStarted,      ///< number: the process id of the program
    kStartFailed,  ///< number: why, as errno
    kEnded,        ///< number: the program's wait status; what it started may live on
  };
  Kind kind = Kind::kStarted;
  std::int32_t number = 0;
};

inline constexpr int kWatchReportsDescriptor = 3;
inline constexpr int kWatchSignalsDescriptor = 4;

}  // namespace adit
