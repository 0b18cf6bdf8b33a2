// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/service/wait_status.hpp"

#include <cstring>
#include <string>

#include <sys/wait.h>

namespace adit {

std::string wait_status_text(int wait_status) {
  if (!WIFSIGNALED(wait_status))
    return "ended with exit code " + std::to_string(WEXITSTATUS(wait_status));
  const int signal = WTERMSIG(wait_status);
  const char* const name = sigabbrev_np(signal);
  return "killed by " + (name ? "SIG" + std::string(name) : "signal " + std::to_string(signal));
}

}  // namespace adit
