// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <sys/socket.h>
#include <sys/un.h>

namespace adit {

/// Address of a Unix domain socket. Throws std::runtime_error if the path is too long for sun_path.
inline sockaddr_un unix_address(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.size() >= sizeof(address.sun_path)) {
    throw std::runtime_error(text + ": path too long for a socket");
  }
  std::ranges::copy(text, address.sun_path);
  return address;
}

inline const sockaddr* to_sockaddr(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

/// Default socket of a supervisor of this user: in XDG_RUNTIME_DIR, else in /run/adit for root,
/// else in /tmp/adit-UID.
std::filesystem::path default_socket_path();

/// Socket that a client of this user connects to: default_socket_path() if it exists, else that of
/// the system's supervisor in /run/adit if it exists and is visible to this user.
std::filesystem::path find_socket_path();

}  // namespace adit
