// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procs/supervisor/os/descriptor.hpp"

namespace adit {

/// SIGHUP, by which a daemon is asked to read its files again, as something to be asked for. It is
/// to be blocked before any thread is made, which inherits that; else it ends the process.
class ReloadSignal {
 public:
  static void block();

  /// Throws std::system_error.
  ReloadSignal();

  /// Whether it came since the last time that this was asked, without waiting for it.
  [[nodiscard]] bool came() const;

 private:
  Descriptor descriptor_;
};

}  // namespace adit
