// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ports/tcp_port.hpp"

#include <cerrno>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/ports/descriptor_io.hpp"

#include "common/text/message_text.hpp"

namespace adit {

std::string TcpPort::open() {
  close();
  addrinfo hints{};
  hints.ai_family = AF_INET;  // the service permits no other
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int failed = getaddrinfo(host_.c_str(), port_.c_str(), &hints, &found);
  if (failed != 0) return fmt::format("{}: {}", quote(host_), gai_strerror(failed));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> address(found, &freeaddrinfo);
  descriptor_ = socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (connect(descriptor_, address->ai_addr, address->ai_addrlen) == 0 || errno == EINPROGRESS) {
    return {};
  }
  const std::string reason = std::strerror(errno);
  close();
  return fmt::format("cannot connect to {}: {}", quote(host_ + ":" + port_), reason);
}

void TcpPort::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  is_connected_ = false;
}

TcpPort::State TcpPort::state() {
  if (is_connected_) return State::kConnected;
  pollfd writable{descriptor_, POLLOUT, 0};
  if (poll(&writable, 1, 0) <= 0) return State::kConnecting;
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &error, &size);
  is_connected_ = error == 0;
  return is_connected_ ? State::kConnected : State::kFailed;
}

std::optional<std::size_t> TcpPort::read(std::span<std::uint8_t> bytes) {
  const State now = state();
  if (now == State::kConnecting) return 0;
  if (now == State::kFailed) return std::nullopt;
  return read_available(descriptor_, bytes, EndOfData::kIsEnd);
}

bool TcpPort::write(std::span<const std::uint8_t> bytes) {
  const State now = state();
  if (now == State::kConnecting) return true;
  return now == State::kConnected && write_available(descriptor_, bytes);
}

}  // namespace adit
