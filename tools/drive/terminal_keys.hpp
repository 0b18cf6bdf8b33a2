// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <termios.h>

#include "tools/drive/key_driver.hpp"

namespace adit {

/// Keys as they are pressed, not shown and without Enter; the terminal is as before when this goes.
/// Throws std::runtime_error where standard input is no terminal.
class TerminalKeys {
 public:
  TerminalKeys();
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  /// Since the last call; does not wait.
  std::vector<DriveKey> pressed();

 private:
  termios before_{};
  KeyReader reader_;
};

}  // namespace adit
