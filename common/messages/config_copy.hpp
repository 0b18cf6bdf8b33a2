// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "adit/config_t.hpp"

#include "common/messages/result.hpp"

namespace adit {

/// The configuration in effect, as it goes onto channel CONFIG.
struct ConfigCopy {
  std::int64_t utime = 0;  ///< bus time [µs since the epoch]
  std::string stage;
  std::string version;
  std::string yaml;

  friend bool operator==(const ConfigCopy&, const ConfigCopy&) = default;
};

config_t to_message(const ConfigCopy& copy);

/// Refused: an implausible time, no stage.
Result<ConfigCopy> from_message(const config_t& message);

}  // namespace adit
