// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace adit {

/// A server for one connection on this computer, at a port of its own.
class TcpLine {
 public:
  /// Throws std::system_error.
  TcpLine();
  ~TcpLine();
  TcpLine(const TcpLine&) = delete;
  TcpLine& operator=(const TcpLine&) = delete;

  /// tcp://127.0.0.1:PORT
  [[nodiscard]] std::string address() const;

  void disconnect();

  /// What the peer wrote. A new connection replaces one that was lost.
  std::vector<std::uint8_t> read();
  /// What does not fit is lost.
  void write(std::span<const std::uint8_t> bytes);

 private:
  int listener_ = -1;
  int peer_ = -1;
  int port_ = 0;
};

/// Runs an emulated laser on such a line in real time.
template <class Emulator>
class TcpLaser {
 public:
  explicit TcpLaser(Emulator& laser) : laser_(laser) {}

  [[nodiscard]] std::string address() const { return line_.address(); }
  void disconnect() { line_.disconnect(); }

  /// To be called every millisecond or so. `utime`: now.
  void step(std::int64_t utime) {
    laser_.receive(line_.read(), 0, utime);
    std::vector<std::uint8_t> bytes;
    for (const auto& timed : laser_.advance(utime, 0)) bytes.push_back(timed.byte);
    line_.write(bytes);
  }

 private:
  TcpLine line_;
  Emulator& laser_;
};

}  // namespace adit
