// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace adit {

struct SpawnOptions {
  std::vector<std::string> arguments;  ///< the program first, with its path
  std::vector<std::string> environment;
  std::vector<int> descriptors;  ///< become 0, 1, 2, ..; all are higher; no other is inherited
};

/// Starts a program, with no signal blocked or ignored, and returns its process id. No other code
/// of this process runs in the child, which matters where there are threads. Throws
/// std::system_error.
pid_t spawn(const SpawnOptions& options);

/// That of this process, with the additions, and with the folder at the end of PATH.
std::vector<std::string> environment_with(
    const std::vector<std::pair<std::string, std::string>>& additions, const std::string& folder);

}  // namespace adit
