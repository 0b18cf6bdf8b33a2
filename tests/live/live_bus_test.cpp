// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// LcmBus to LcmBus over a real network. To be run by in_private_network.sh.
#include <chrono>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/bus/channel_filter.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/lcm_transport.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;

class LiveBus : public testing::Test {
 protected:
  /// Drives the receiver until the condition holds; fails after ten seconds.
  void receive_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << "waited in vain";
      receiver_.handle(100);
    }
  }

  Handler keep() {
    return [this](const ReceivedMessage& received) -> std::string_view {
      kept_.emplace_back(received.bytes.begin(), received.bytes.end());
      return {};
    };
  }

  LcmBus sender_;
  LcmBus receiver_;
  std::vector<Bytes> kept_;
};

TEST_F(LiveBus, CarriesMessagesInOrder) {
  receiver_.subscribe("POSE", Delivery::queued(100), keep());
  for (std::uint8_t i = 0; i < 50; ++i) sender_.publish("POSE", Bytes{i});
  receive_until([&] { return kept_.size() == 50; });
  for (std::uint8_t i = 0; i < 50; ++i) EXPECT_EQ(kept_.at(i), Bytes{i});
}

TEST_F(LiveBus, CarriesAMessageOfManyFragments) {
  receiver_.subscribe("CLOUD", Delivery::queued(100), keep());
  Bytes large(150'000);
  std::iota(large.begin(), large.end(), 0);
  const auto arrived = [&] { return !kept_.empty(); };
  for (int attempt = 0; attempt < 20 && !arrived(); ++attempt) {  // a small buffer loses some
    sender_.publish("CLOUD", large);
    for (int i = 0; i < 5 && !arrived(); ++i) receiver_.handle(20);
  }
  ASSERT_TRUE(arrived());
  EXPECT_EQ(kept_[0], large);
}

/// What the kernel lets a socket hold.
int largest_receive_buffer() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  int bytes = static_cast<int>(kReceiveBufferBytes);
  socklen_t size = sizeof(bytes);
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, size);
  getsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, &size);
  close(socket);
  return bytes;
}

TEST_F(LiveBus, LosesNoPartOfAMegabyteWhereTheKernelHoldsIt) {
  if (largest_receive_buffer() < kReceiveBufferBytes) {
    GTEST_SKIP() << "net.core.rmem_max is small; see deploy/sysctl";
  }
  receiver_.subscribe("CLOUD", Delivery::queued(100), keep());
  const Bytes large(1'000'000, 7);
  sender_.publish("CLOUD", large);  // while nobody receives
  receive_until([&] { return !kept_.empty(); });
  EXPECT_EQ(kept_.at(0), large);
}

TEST_F(LiveBus, KeepsTheNewestStateOverAStall) {
  receiver_.subscribe("POSE", Delivery::latest(), keep());
  receiver_.subscribe("IMU", Delivery::queued(100),
                      [](const ReceivedMessage&) { return std::string_view(); });
  for (std::uint8_t i = 0; i < 100; ++i) sender_.publish("POSE", Bytes{i});
  sender_.publish("IMU", {});
  receive_until([&] { return !kept_.empty() && kept_.back() == Bytes{99}; });
  EXPECT_LT(kept_.size(), 100U);
}

/// Of the filters of all sockets by which this process receives.
std::vector<socklen_t> lengths_of_filters() {
  std::vector<socklen_t> lengths;
  for (const int socket : bound_datagram_sockets()) {
    socklen_t length = 0;  // 0 asks for it
    getsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, nullptr, &length);
    lengths.push_back(length);
  }
  return lengths;
}

TEST_F(LiveBus, LetsTheKernelDropWhatNobodyHereSubscribedTo) {
  receiver_.subscribe("POSE", Delivery::queued(100), keep());
  receiver_.subscribe("IMU", Delivery::queued(100), keep());
  const auto length = static_cast<socklen_t>(channel_filter({"POSE", "IMU"}).size());
  EXPECT_THAT(lengths_of_filters(), testing::Contains(length));
  sender_.publish("GAS", Bytes{1});
  sender_.publish("IMU", Bytes{2});
  receive_until([&] { return !kept_.empty(); });
  EXPECT_EQ(kept_.at(0), Bytes{2});
}

TEST_F(LiveBus, SurvivesDatagramsThatAreNotOfLcm) {
  receiver_.subscribe("POSE", Delivery::queued(100), keep());
  receiver_.handle(0);
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(7667);
  inet_aton("239.255.76.67", &address.sin_addr);
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    Bytes datagram(random() % 100);
    for (std::uint8_t& byte : datagram) byte = static_cast<std::uint8_t>(random());
    sendto(socket, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&address),
           sizeof(address));
  }
  close(socket);
  receive_until([&] {  // again and again, since a full buffer of the kernel loses some
    sender_.publish("POSE", Bytes{7});
    return !kept_.empty();
  });
  EXPECT_EQ(kept_.at(0), Bytes{7});
}

}  // namespace
}  // namespace adit
