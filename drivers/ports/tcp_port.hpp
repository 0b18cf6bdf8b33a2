// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "drivers/ports/byte_port.hpp"

namespace adit {

/// A connection by TCP to a device or a serial server. Names are resolved when it is opened.
class TcpPort final : public BytePort {
 public:
  TcpPort(std::string host, std::string port) : host_(std::move(host)), port_(std::move(port)) {}
  ~TcpPort() override { close(); }
  TcpPort(const TcpPort&) = delete;
  TcpPort& operator=(const TcpPort&) = delete;

  /// Begins to connect. Until then reads return 0 bytes, and what is written is dropped.
  std::string open() override;
  void close() override;
  [[nodiscard]] int descriptor() const override { return descriptor_; }
  std::optional<std::size_t> read(std::span<std::uint8_t> bytes) override;
  bool write(std::span<const std::uint8_t> bytes) override;

 private:
  enum class State { kConnecting, kConnected, kFailed };
  State state();

  std::string host_;
  std::string port_;
  int descriptor_ = -1;
  bool is_connected_ = false;
};

}  // namespace adit
