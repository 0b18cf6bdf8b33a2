// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/serial_port.hpp"
#include "drivers/ports/tcp_port.hpp"

#include "common/text/message_text.hpp"

namespace adit {

std::unique_ptr<BytePort> make_port(const std::string& address) {
  constexpr std::string_view kTcp = "tcp://";
  if (address.starts_with('/')) return std::make_unique<SerialPort>(address);
  const std::size_t colon = address.rfind(':');
  if (address.starts_with(kTcp) && colon > kTcp.size() && colon + 1 < address.size()) {
    return std::make_unique<TcpPort>(address.substr(kTcp.size(), colon - kTcp.size()),
                                     address.substr(colon + 1));
  }
  throw std::invalid_argument(fmt::format(
      "device is {}: it must be the path of a serial device, or tcp://HOST:PORT", quote(address)));
}

}  // namespace adit
