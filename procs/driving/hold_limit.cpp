// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/hold_limit.hpp"

#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {

void HoldLimit::go_on(std::int64_t utime, double way_m, bool held) {
  if (std::abs(way_m - way_m_) >= kWayM) since_utime_.reset();
  if (!since_utime_) {
    way_m_ = way_m;
    if (held) since_utime_ = utime;
  }
  const double since_s = seconds(utime - since_utime_.value_or(utime));
  reached_ = held && since_s > seconds_max_;
}

}  // namespace adit
