// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>

namespace adit {

/// Turns SIGINT and SIGTERM into a descriptor that can be read from. Must be made before any thread
/// is, since threads inherit that the signals are blocked. Throws std::system_error.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Whether one of the signals came, without waiting for it.
  [[nodiscard]] bool received() const;

 private:
  sigset_t previous_{};
  int descriptor_ = -1;
};

}  // namespace adit
