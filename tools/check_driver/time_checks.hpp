// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tools/check_driver/channel_reading.hpp"
#include "tools/check_driver/check_result.hpp"

namespace adit {

/// Stamps and arrivals of the messages of a channel, in order of arrival [µs since the epoch].
struct MessageTimes {
  std::vector<std::int64_t> stamps;
  std::vector<std::int64_t> arrivals;
};

/// Checks rate, gaps, order and regularity of the stamps, and the clock that made them.
CheckResults check_times(const DriverChannel& channel, const MessageTimes& times);

}  // namespace adit
