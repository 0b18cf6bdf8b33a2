// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lasers/tcp_laser.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace adit {

TcpLine::TcpLine() : listener_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(listener_, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      listen(listener_, 1) != 0 ||
      getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw std::system_error(errno, std::generic_category(), "listening socket");
  }
  port_ = ntohs(address.sin_port);
}

TcpLine::~TcpLine() {
  disconnect();
  close(listener_);
}

std::string TcpLine::address() const { return fmt::format("tcp://127.0.0.1:{}", port_); }

void TcpLine::disconnect() {
  if (peer_ >= 0) close(peer_);
  peer_ = -1;
}

std::vector<std::uint8_t> TcpLine::read() {
  const int peer = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (peer >= 0) {
    disconnect();
    peer_ = peer;
  }
  std::array<std::uint8_t, 4096> buffer{};
  const ssize_t count = peer_ >= 0 ? ::read(peer_, buffer.data(), buffer.size()) : 0;
  if (count <= 0) return {};
  return {buffer.begin(), buffer.begin() + count};
}

void TcpLine::write(std::span<const std::uint8_t> bytes) {
  if (peer_ < 0 || bytes.empty()) return;
  if (send(peer_, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0 && errno != EAGAIN) disconnect();
}

}  // namespace adit
