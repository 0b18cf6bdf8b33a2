// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace adit {

/// Who started this process and wants to hear how it fares (systemd, Type=notify): what sd_notify
/// does, by the socket that NOTIFY_SOCKET names. Nothing where nobody asks, and it never waits.
class ServiceManager {
 public:
  ServiceManager();

  /// "READY=1", "WATCHDOG=1", "STATUS=…", one on each line.
  void tell(std::string_view state) const;

 private:
  std::string socket_;
};

}  // namespace adit
