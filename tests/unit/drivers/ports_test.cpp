// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/reconnecting_port.hpp"

#include "tests/support/lasers/pty_line.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000;

bool is_readable(int descriptor, int timeout_ms) {
  pollfd state{descriptor, POLLIN, 0};
  return poll(&state, 1, timeout_ms) > 0;
}

Bytes read_from(ReconnectingPort& port) {
  EXPECT_TRUE(is_readable(port.descriptor(), 5000));
  const auto bytes = port.read();
  return {bytes.begin(), bytes.end()};
}

TEST(ReconnectingPort, TransfersBytesOfASerialLineAndSetsItsRate) {
  const test::ScratchFolder folder;
  PtyLine line(folder / "tty");
  ReconnectingPort port((folder / "tty").string());
  ASSERT_TRUE(port.open_if_due(kSecond)) << port.failure();
  EXPECT_EQ(line.host_baud(), 9600);
  port.set_baud(500000);
  EXPECT_EQ(line.host_baud(), 500000);
  // Control characters of terminals are bytes like others.
  const Bytes all{0x00, 0x03, 0x0A, 0x0D, 0x11, 0x13, 0x7F, 0xFF};
  port.write(all);
  EXPECT_EQ(line.read(), all);
  EXPECT_TRUE(port.read().empty());
  line.write(all);
  EXPECT_EQ(read_from(port), all);
}

TEST(ReconnectingPort, OpensALineThatWasUnpluggedAgain) {
  const test::ScratchFolder folder;
  PtyLine line(folder / "tty");
  ReconnectingPort port((folder / "tty").string());
  ASSERT_TRUE(port.open_if_due(kSecond));
  line.unplug();
  EXPECT_TRUE(port.read().empty());
  EXPECT_FALSE(port.is_open());
  EXPECT_THAT(port.failure(), HasSubstr("was disconnected"));
  EXPECT_FALSE(port.open_if_due(2 * kSecond));
  EXPECT_THAT(port.failure(), HasSubstr("No such file"));
  line.plug();
  EXPECT_FALSE(port.open_if_due(2 * kSecond + 1000));  // not yet time
  EXPECT_TRUE(port.open_if_due(3 * kSecond));
  line.write(Bytes{42});
  EXPECT_THAT(read_from(port), ElementsAre(42));
}

TEST(ReconnectingPort, SaysWhyADeviceCannotBeOpened) {
  const test::ScratchFolder folder;
  ReconnectingPort missing((folder / "none").string());
  EXPECT_FALSE(missing.open_if_due(0));
  EXPECT_THAT(missing.failure(), HasSubstr("cannot open"));
  ReconnectingPort file("/dev/null");
  EXPECT_FALSE(file.open_if_due(0));
  EXPECT_THAT(file.failure(), HasSubstr("not a serial device"));
  EXPECT_THROW(ReconnectingPort("ttyS0"), std::invalid_argument);
  EXPECT_THROW(ReconnectingPort("tcp://host"), std::invalid_argument);
  EXPECT_THROW(ReconnectingPort("tcp://:80"), std::invalid_argument);
}

/// A socket on this computer that listens, and its port.
class Listener {
 public:
  Listener() : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
        listen(descriptor_, 1) != 0 ||
        getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      throw std::runtime_error("cannot listen");
    }
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { close(descriptor_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] std::string address() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  [[nodiscard]] int accept() const {
    EXPECT_TRUE(is_readable(descriptor_, 5000));
    return ::accept(descriptor_, nullptr, nullptr);
  }

 private:
  int descriptor_;
  int port_ = 0;
};

TEST(ReconnectingPort, TransfersBytesByTcpAndConnectsAgain) {
  const Listener listener;
  ReconnectingPort port(listener.address());
  ASSERT_TRUE(port.open_if_due(kSecond)) << port.failure();
  int peer = listener.accept();
  ASSERT_EQ(write(peer, "abc", 3), 3);
  EXPECT_THAT(read_from(port), ElementsAre('a', 'b', 'c'));
  port.write(Bytes{'x'});
  char byte = 0;
  EXPECT_EQ(read(peer, &byte, 1), 1);
  EXPECT_EQ(byte, 'x');
  close(peer);
  EXPECT_THAT(read_from(port), ElementsAre());
  EXPECT_FALSE(port.is_open());
  ASSERT_TRUE(port.open_if_due(3 * kSecond));
  peer = listener.accept();
  ASSERT_EQ(write(peer, "d", 1), 1);
  EXPECT_THAT(read_from(port), ElementsAre('d'));
  close(peer);
}

TEST(ReconnectingPort, IsLostWhenNobodyListens) {
  std::string address;
  {
    const Listener listener;
    address = listener.address();
  }
  ReconnectingPort port(address);
  if (port.open_if_due(kSecond)) read_from(port);
  EXPECT_FALSE(port.is_open());
  EXPECT_NE(port.failure(), "");
}

}  // namespace
}  // namespace adit
