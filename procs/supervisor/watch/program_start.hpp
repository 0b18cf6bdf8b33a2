// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace adit {

struct ProgramStart {
  pid_t pid = -1;
  int error = 0;  ///< as errno; 0: the program runs
};

/// Runs a program, looked for in PATH, as a child in a session of its own, whose terminal is the
/// standard input where that is one; with no signal blocked or ignored, and killed by the kernel if
/// this process ends. `argv` ends with a null pointer.
ProgramStart start_program(char* const* argv);

}  // namespace adit
