// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/progress_monitor.hpp"

#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {

void HoldTimeout::update(std::int64_t utime, double distance_m, bool held) {
  if (std::abs(distance_m - distance_m_) >= kProgressM) since_utime_.reset();
  if (!since_utime_) {
    distance_m_ = distance_m;
    if (held) since_utime_ = utime;
  }
  const double since_s = seconds(utime - since_utime_.value_or(utime));
  reached_ = held && since_s > seconds_max_;
}

}  // namespace adit
