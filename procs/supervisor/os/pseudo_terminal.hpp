// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procs/supervisor/os/descriptor.hpp"

namespace adit {

/// A terminal without a screen, so that programs print line by line. It changes nothing in what
/// goes through it and repeats nothing that is typed.
struct PseudoTerminal {
  Descriptor ours;  ///< does not block
  Descriptor theirs;

  /// Throws std::system_error.
  static PseudoTerminal open();
};

}  // namespace adit
