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

/// The address of a socket in the file system. Throws std::runtime_error where the path is longer
/// than the system takes.
inline sockaddr_un unix_address(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.size() >= sizeof(address.sun_path)) {
    throw std::runtime_error(text + ": too long for a socket");
  }
  std::ranges::copy(text, address.sun_path);
  return address;
}

inline const sockaddr* to_sockaddr(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

/// Where a supervisor of this user listens to `adit ps` and the like: in XDG_RUNTIME_DIR, else in
/// /run/adit for root, else in a folder of the user's own below /tmp.
std::filesystem::path default_socket_path();

/// Where a terminal of this user finds a supervisor: there, or else, where it may look into it, in
/// /run/adit, which has the one that the system starts.
std::filesystem::path find_socket_path();

}  // namespace adit
