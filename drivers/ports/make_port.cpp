// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/serial_port.hpp"
#include "drivers/ports/tcp_port.hpp"
#include "drivers/ports/udp_port.hpp"

#include "common/text/message_text.hpp"

namespace adit {

std::unique_ptr<BytePort> make_port(const std::string& address) {
  constexpr std::string_view kTcp = "tcp://";
  constexpr std::string_view kUdp = "udp://";  // as long
  if (address.starts_with('/')) return std::make_unique<SerialPort>(address);
  const std::size_t colon = address.rfind(':');
  if (colon != std::string::npos && colon > kTcp.size() && colon + 1 < address.size()) {
    const std::string host = address.substr(kTcp.size(), colon - kTcp.size());
    const std::string port = address.substr(colon + 1);
    if (address.starts_with(kTcp)) return std::make_unique<TcpPort>(host, port);
    if (address.starts_with(kUdp)) return std::make_unique<UdpPort>(host, port);
  }
  throw std::invalid_argument(
      fmt::format("device is {}: it must be the path of a serial device, tcp://HOST:PORT or "
                  "udp://HOST:PORT",
                  quote(address)));
}

}  // namespace adit
