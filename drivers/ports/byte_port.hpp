// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace adit {

/// A connection to a device that transfers bytes and never blocks. A device may be unplugged and
/// switched off at any time, so that a failure is a state and no exception; ReconnectingPort opens
/// the connection again.
class BytePort {
 public:
  virtual ~BytePort() = default;

  /// Opens the connection. Returns the reason if that fails, one clause; otherwise empty. A
  /// connection by TCP may still fail behind that.
  virtual std::string open() = 0;
  virtual void close() = 0;

  /// To wait on; negative while closed.
  [[nodiscard]] virtual int descriptor() const = 0;

  /// Reads what has arrived, 0 bytes if nothing has. Nothing if the connection is lost.
  virtual std::optional<std::size_t> read(std::span<std::uint8_t> bytes) = 0;

  /// False if the connection is lost. What does not fit into the buffer of the system is dropped,
  /// since requests to a device are repeated.
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;

  /// Drops what has arrived. False if the connection is lost or has no such rate; connections
  /// without baud rate accept any.
  virtual bool set_baud(int /*baud*/) { return true; }
};

/// The port of an address: "tcp://HOST:PORT", "udp://HOST:PORT" (datagrams of the host to this port
/// of the computer, of all senders for 0.0.0.0), or the path of a serial device. Throws
/// std::invalid_argument for any other text.
std::unique_ptr<BytePort> make_port(const std::string& address);

}  // namespace adit
