// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/terminal/socket_path.hpp"

#include <cstdlib>
#include <string>

#include <unistd.h>

namespace adit {

std::filesystem::path default_socket_path() {
  constexpr const char* kName = "supervisor.sock";
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime && *runtime) return std::filesystem::path(runtime) / "adit" / kName;
  if (geteuid() == 0) return std::filesystem::path("/run/adit") / kName;
  return std::filesystem::path("/tmp/adit-" + std::to_string(geteuid())) / kName;
}

}  // namespace adit
