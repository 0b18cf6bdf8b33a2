// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace adit {

/// How a process ended, by its status of waitpid(2): "ended with exit code 3", "killed by SIGSEGV".
std::string wait_status_text(int wait_status);

}  // namespace adit
