// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ports/udp_port.hpp"

#include <cerrno>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr int kBufferBytes = 1'000'000;  // half a second of a VLP-16; the system may allow less

}  // namespace

std::string UdpPort::open() {
  close();
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int failed = getaddrinfo(host_.c_str(), port_.c_str(), &hints, &found);
  if (failed != 0) return fmt::format("{}: {}", quote(host_), gai_strerror(failed));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> resolved(found, &freeaddrinfo);
  sockaddr_in address{};
  std::memcpy(&address, resolved->ai_addr, sizeof address);
  sender_ = address.sin_addr.s_addr;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  descriptor_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &kBufferBytes, sizeof kBufferBytes);
  if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    return {};
  const std::string reason = std::strerror(errno);
  close();
  return fmt::format("cannot listen on UDP port {}: {}", quote(port_), reason);
}

void UdpPort::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

std::optional<std::size_t> UdpPort::read(std::span<std::uint8_t> bytes) {
  for (;;) {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t count = recvfrom(descriptor_, bytes.data(), bytes.size(), 0,
                                   reinterpret_cast<sockaddr*>(&from), &size);
    if (count < 0) {
      const bool is_temporary = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
      return is_temporary ? std::optional<std::size_t>(0) : std::nullopt;
    }
    const bool is_sender = sender_ == 0 || sender_ == from.sin_addr.s_addr;
    if (is_sender && count > 0) return static_cast<std::size_t>(count);
  }
}

}  // namespace adit
