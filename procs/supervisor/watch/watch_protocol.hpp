// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// Protocol between adit-watch and the supervisor, on two sockets. To adit-watch: single bytes, the
/// number of a signal for all descendants; SIGKILL is repeated until all have ended. From
/// adit-watch: reports in native byte order.
struct WatchReport {
  enum class Kind : std::int32_t {
    kStarted,      ///< number: process id of the program
    kStartFailed,  ///< number: errno
    kEnded,        ///< number: wait status of the program; descendants may still run
  };
  Kind kind = Kind::kStarted;
  std::int32_t number = 0;
};

inline constexpr int kWatchReportsDescriptor = 3;
inline constexpr int kWatchSignalsDescriptor = 4;
/// A listening socket for the program, if it gets one: adit-watch passes it on as systemd does
/// (sd_listen_fds(3)), as descriptor 3 with LISTEN_FDS and LISTEN_PID.
inline constexpr int kWatchListenDescriptor = 5;

}  // namespace adit
