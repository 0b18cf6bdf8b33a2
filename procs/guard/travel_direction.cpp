// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/travel_direction.hpp"

#include <algorithm>
#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kGapMaxS =
    0.5;  // between readings; how far it travelled in a longer one is unknown

}  // namespace

void TravelDirection::add(double speed_m_s, std::int64_t at_us) {
  const double dt = at_us_ ? std::min(seconds(at_us - *at_us_), kGapMaxS) : 0.0;
  at_us_ = at_us;
  if (!(std::abs(speed_m_s) >= kStandsM_S)) return;
  const int direction = speed_m_s > 0.0 ? 1 : -1;
  if (direction_ == 0) direction_ = direction;
  back_m_ = std::max(back_m_ - direction_ * speed_m_s * dt, 0.0);
  if (back_m_ < kReversalM) return;
  direction_ = direction;
  back_m_ = 0.0;
}

}  // namespace adit
