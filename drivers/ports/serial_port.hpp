// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "drivers/ports/byte_port.hpp"

namespace adit {

/// A serial device: 8 bits, no parity, one stop bit, no flow control, for this process alone.
class SerialPort final : public BytePort {
 public:
  explicit SerialPort(std::string path) : path_(std::move(path)) {}
  ~SerialPort() override { close(); }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// At 9600 baud. A path without a serial device is a failure.
  std::string open() override;
  void close() override;
  [[nodiscard]] int descriptor() const override { return descriptor_; }
  std::optional<std::size_t> read(std::span<std::uint8_t> bytes) override;
  bool write(std::span<const std::uint8_t> bytes) override;
  bool set_baud(int baud) override;

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace adit
