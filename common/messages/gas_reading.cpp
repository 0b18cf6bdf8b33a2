// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/gas_reading.hpp"

#include "common/messages/checks.hpp"

namespace adit {

gas_t to_message(const GasReading& reading) {
  gas_t message;
  message.utime = reading.utime;
  message.methane_share = reading.methane_share;
  message.oxygen_share = reading.oxygen_share;
  message.carbon_monoxide_share = reading.carbon_monoxide_share;
  return message;
}

Result<GasReading> from_message(const gas_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!is_share(message.methane_share)) return Refused{kNoShare};
  if (!is_share(message.oxygen_share)) return Refused{kNoShare};
  if (!is_share(message.carbon_monoxide_share)) return Refused{kNoShare};
  return GasReading{message.utime, message.methane_share, message.oxygen_share,
                    message.carbon_monoxide_share};
}

}  // namespace adit
