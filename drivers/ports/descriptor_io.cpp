// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ports/descriptor_io.hpp"

#include <cerrno>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace adit {
namespace {

bool is_temporary(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

bool is_hung_up(int descriptor) {
  pollfd state{descriptor, POLLIN, 0};
  return poll(&state, 1, 0) > 0 && (state.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

}  // namespace

std::optional<std::size_t> read_available(int descriptor, std::span<std::uint8_t> bytes,
                                          EndOfData end_of_data) {
  const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && !is_temporary(errno)) return std::nullopt;
  if (count == 0 && end_of_data == EndOfData::kIsEnd) return std::nullopt;
  if (end_of_data == EndOfData::kIsHangUp && is_hung_up(descriptor)) return std::nullopt;
  return 0;
}

bool write_available(int descriptor, std::span<const std::uint8_t> bytes) {
  // A socket whose peer has gone would end the process by SIGPIPE.
  ssize_t count = send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (count < 0 && errno == ENOTSOCK) count = ::write(descriptor, bytes.data(), bytes.size());
  return count >= 0 || is_temporary(errno);
}

}  // namespace adit
