// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/config_copy.hpp"

#include "common/messages/checks.hpp"

namespace adit {

config_t to_message(const ConfigCopy& copy) {
  config_t message;
  message.utime = copy.utime;
  message.stage = copy.stage;
  message.version = copy.version;
  message.yaml = copy.yaml;
  return message;
}

Result<ConfigCopy> from_message(const config_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.stage.empty()) return Refused{"no stage"};
  return ConfigCopy{message.utime, message.stage, message.version, message.yaml};
}

}  // namespace adit
