// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace adit {

/// Notifications to systemd: the protocol of sd_notify(3) on the socket NOTIFY_SOCKET. Has no
/// effect without that variable and never blocks.
class ServiceManager {
 public:
  ServiceManager();

  /// `state`: "READY=1", "WATCHDOG=1", "STATUS=...", one per line.
  void notify(std::string_view state) const;

  /// The listening socket that systemd or a parent passes to this process (sd_listen_fds(3)); the
  /// variables that name it are removed, so that no child takes it for its own.
  [[nodiscard]] static std::optional<int> take_listening_socket();

  /// Whether systemd expects "WATCHDOG=1" of this process itself (WATCHDOG_PID), not of its parent.
  [[nodiscard]] static bool expects_watchdog();

 private:
  std::string socket_;
};

}  // namespace adit
