// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "drivers/ports/byte_port.hpp"

namespace adit {

/// Datagrams by UDP that a device sends to a port of this computer. Each read returns one datagram,
/// or what fits of it.
class UdpPort final : public BytePort {
 public:
  /// `host`: the address of the device, whose datagrams alone are read, or 0.0.0.0 for those of all
  /// senders. `port`: of this computer.
  UdpPort(std::string host, std::string port) : host_(std::move(host)), port_(std::move(port)) {}
  ~UdpPort() override { close(); }
  UdpPort(const UdpPort&) = delete;
  UdpPort& operator=(const UdpPort&) = delete;

  std::string open() override;
  void close() override;
  [[nodiscard]] int descriptor() const override { return descriptor_; }
  std::optional<std::size_t> read(std::span<std::uint8_t> bytes) override;
  /// Nothing is sent.
  bool write(std::span<const std::uint8_t> /*bytes*/) override { return true; }

 private:
  std::string host_;
  std::string port_;
  int descriptor_ = -1;
  std::uint32_t sender_ = 0;  ///< address in network order, 0: any
};

}  // namespace adit
