// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {

/// SIGHUP, by which a daemon is asked to read its files again, as something to be asked for. It is
/// to be blocked before any thread is made, which inherits that; else it ends the process.
class ReloadSignal {
 public:
  static void block();

  /// Throws std::system_error.
  ReloadSignal();

  /// Whether it came since the last time that this was asked, without waiting for it.
  [[nodiscard]] bool received() const;

 private:
  FileDescriptor descriptor_;
};

/// Who started this process and wants to hear how it fares (systemd, Type=notify): what sd_notify
/// does, by the socket that NOTIFY_SOCKET names. Nothing where nobody asks, and it never waits.
class ServiceManager {
 public:
  ServiceManager();

  /// "READY=1", "WATCHDOG=1", "STATUS=…", one on each line.
  void notify(std::string_view state) const;

 private:
  std::string socket_;
};

}  // namespace adit
