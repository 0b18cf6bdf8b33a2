// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/pseudo_terminal.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <termios.h>

namespace adit {
namespace {

void require(bool good, const char* what) {
  if (!good) throw std::system_error(errno, std::generic_category(), what);
}

void change_nothing(int terminal) {
  termios settings{};
  require(tcgetattr(terminal, &settings) == 0, "tcgetattr");
  settings.c_oflag &= ~static_cast<tcflag_t>(OPOST);
  settings.c_lflag &= ~static_cast<tcflag_t>(ECHO | ECHONL);
  require(tcsetattr(terminal, TCSANOW, &settings) == 0, "tcsetattr");
}

}  // namespace

PseudoTerminal PseudoTerminal::open() {
  PseudoTerminal terminal;
  terminal.ours = Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  require(static_cast<bool>(terminal.ours), "posix_openpt");
  require(grantpt(terminal.ours.get()) == 0 && unlockpt(terminal.ours.get()) == 0, "unlockpt");
  std::array<char, 64> name{};
  require(ptsname_r(terminal.ours.get(), name.data(), name.size()) == 0, "ptsname");
  terminal.theirs = Descriptor(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  require(static_cast<bool>(terminal.theirs), "a pseudo terminal");
  change_nothing(terminal.theirs.get());
  return terminal;
}

}  // namespace adit
