// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/drive/terminal_keys.hpp"

#include <array>
#include <stdexcept>

#include <poll.h>
#include <unistd.h>

namespace adit {

TerminalKeys::TerminalKeys() {
  if (tcgetattr(STDIN_FILENO, &before_) != 0) {
    throw std::runtime_error("standard input is no terminal, so there are no keys");
  }
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

TerminalKeys::~TerminalKeys() { tcsetattr(STDIN_FILENO, TCSANOW, &before_); }

std::vector<DriveKey> TerminalKeys::pressed() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (poll(&input, 1, 0) <= 0) return {};
  std::array<char, 64> bytes{};
  const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
  if (count <= 0) return {DriveKey::kQuit};  // the terminal is gone
  return reader_.read({bytes.data(), static_cast<std::size_t>(count)});
}

}  // namespace adit
