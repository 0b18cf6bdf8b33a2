// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/terminal/socket_path.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

#include <unistd.h>

namespace adit {
namespace {

constexpr const char* kName = "supervisor.sock";

std::filesystem::path socket_of_the_system() { return std::filesystem::path("/run/adit") / kName; }

}  // namespace

std::filesystem::path default_socket_path() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime && *runtime) return std::filesystem::path(runtime) / "adit" / kName;
  if (geteuid() == 0) return socket_of_the_system();
  return std::filesystem::path("/tmp/adit-" + std::to_string(geteuid())) / kName;
}

std::filesystem::path socket_path_to_ask() {
  const std::filesystem::path own = default_socket_path();
  std::error_code denied;
  const bool only_the_system = !std::filesystem::exists(own, denied) &&
                               std::filesystem::exists(socket_of_the_system(), denied);
  return only_the_system ? socket_of_the_system() : own;
}

}  // namespace adit
