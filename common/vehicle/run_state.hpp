// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// How a simulated run stands.
struct RunState {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  double travelled_m = 0.0;
  std::string failure;  ///< why the run is over; empty while it is not

  friend bool operator==(const RunState&, const RunState&) = default;
};

}  // namespace adit
