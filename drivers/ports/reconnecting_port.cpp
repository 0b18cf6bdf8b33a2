// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ports/reconnecting_port.hpp"

#include <cerrno>
#include <system_error>

#include <fmt/format.h>
#include <sys/epoll.h>
#include <unistd.h>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr std::int64_t kRetryUs = 1'000'000;

}  // namespace

ReconnectingPort::ReconnectingPort(const std::string& address)
    : address_(address), port_(make_port(address)), epoll_(epoll_create1(EPOLL_CLOEXEC)) {
  if (epoll_ < 0) throw std::system_error(errno, std::generic_category(), "epoll_create1");
}

ReconnectingPort::~ReconnectingPort() { close(epoll_); }

bool ReconnectingPort::open_if_due(std::int64_t now_us) {
  if (is_open() || (tried_us_ && now_us - *tried_us_ < kRetryUs)) return false;
  tried_us_ = now_us;
  failure_ = port_->open();
  if (!is_open()) return false;
  epoll_event event{};
  event.events = EPOLLIN;
  if (epoll_ctl(epoll_, EPOLL_CTL_ADD, port_->descriptor(), &event) != 0) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
  return true;
}

/// Closing removes the descriptor from those of epoll_.
void ReconnectingPort::lose(const std::string& reason) {
  port_->close();
  failure_ = fmt::format("{} {}", quote(address_), reason);
}

std::span<const std::uint8_t> ReconnectingPort::read() {
  if (!is_open()) return {};
  const auto count = port_->read(buffer_);
  if (!count) {
    lose("was disconnected");
    return {};
  }
  return std::span<const std::uint8_t>(buffer_).first(*count);
}

void ReconnectingPort::write(std::span<const std::uint8_t> bytes) {
  if (is_open() && !port_->write(bytes)) lose("was disconnected");
}

void ReconnectingPort::set_baud(int baud) {
  if (is_open() && !port_->set_baud(baud)) lose(fmt::format("cannot be set to {} baud", baud));
}

}  // namespace adit
