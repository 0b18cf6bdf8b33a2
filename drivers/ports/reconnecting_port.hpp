// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "drivers/ports/byte_port.hpp"

namespace adit {

/// A port that is opened again a second after it was lost or could not be opened. Its descriptor
/// stays the same, whatever is plugged in: it becomes readable when bytes arrive.
class ReconnectingPort {
 public:
  /// Throws std::invalid_argument for an address that make_port rejects, std::system_error if the
  /// system has no descriptor left.
  explicit ReconnectingPort(const std::string& address);
  ~ReconnectingPort();
  ReconnectingPort(const ReconnectingPort&) = delete;
  ReconnectingPort& operator=(const ReconnectingPort&) = delete;

  /// For Bus::watch.
  [[nodiscard]] int descriptor() const { return epoll_; }

  /// Opens the port if it is closed and time for it. True if it was opened now. Times are those of
  /// a clock that does not jump [µs].
  bool open_if_due(std::int64_t now_us);

  [[nodiscard]] bool is_open() const { return port_->descriptor() >= 0; }

  static constexpr std::size_t kReadBytesMax = 4096;

  /// What has arrived, kReadBytesMax at most; empty if nothing has, or the port is closed. Valid
  /// until the next call.
  std::span<const std::uint8_t> read();

  void write(std::span<const std::uint8_t> bytes);
  void set_baud(int baud);

  /// Why the port is closed, one clause; empty while it is open.
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  void lose(const std::string& reason);

  std::string address_;
  std::unique_ptr<BytePort> port_;
  int epoll_ = -1;
  std::optional<std::int64_t> tried_us_;
  std::string failure_;
  std::array<std::uint8_t, kReadBytesMax> buffer_{};
};

}  // namespace adit
