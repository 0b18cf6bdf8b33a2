// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace adit {

/// Turns SIGINT and SIGTERM into a readable descriptor. Must be created before any thread, since
/// threads inherit the signal mask. Throws std::system_error.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// True if a signal has arrived; does not block.
  [[nodiscard]] bool received() const;

 private:
  sigset_t previous_{};
  int descriptor_ = -1;
};

}  // namespace adit
