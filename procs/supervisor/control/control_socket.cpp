// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/control/control_socket.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

#include <unistd.h>

namespace adit {
namespace {

constexpr const char* kName = "supervisor.sock";

std::filesystem::path system_socket_path() { return std::filesystem::path("/run/adit") / kName; }

}  // namespace

std::filesystem::path default_socket_path() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime && *runtime) return std::filesystem::path(runtime) / "adit" / kName;
  if (geteuid() == 0) return system_socket_path();
  return std::filesystem::path("/tmp/adit-" + std::to_string(geteuid())) / kName;
}

std::filesystem::path find_socket_path() {
  const std::filesystem::path user_path = default_socket_path();
  std::error_code denied;
  const bool only_system = !std::filesystem::exists(user_path, denied) &&
                           std::filesystem::exists(system_socket_path(), denied);
  return only_system ? system_socket_path() : user_path;
}

}  // namespace adit
