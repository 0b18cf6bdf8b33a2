// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {

/// Polls for SIGHUP, the request to a daemon to reload its files. The signal must be blocked before
/// any thread is created, since threads inherit the mask; otherwise it terminates the process.
class ReloadSignal {
 public:
  static void block();

  /// Throws std::system_error.
  ReloadSignal();

  /// Whether the signal was received since the last call; does not block.
  [[nodiscard]] bool received() const;

 private:
  FileDescriptor descriptor_;
};

}  // namespace adit
