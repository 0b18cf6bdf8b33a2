// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// LcmBus to LcmBus over a real network. Run it by in_private_network.sh.
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
#include "common/bus/node/node_host.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;

class LiveBus : public testing::Test {
 protected:
  /// Runs the receiver until the condition is true; fails after ten seconds.
  void receive_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << "timeout";
      receiver_.handle(100);
    }
  }

  Handler store() {
    return [this](const ReceivedMessage& message) -> std::string_view {
      received_.emplace_back(message.bytes.begin(), message.bytes.end());
      return {};
    };
  }

  LcmBus sender_;
  LcmBus receiver_;
  std::vector<Bytes> received_;
};

TEST_F(LiveBus, CarriesMessagesInOrder) {
  receiver_.subscribe("POSE", Delivery::queued(100), store());
  for (std::uint8_t i = 0; i < 50; ++i) sender_.publish("POSE", Bytes{i});
  receive_until([&] { return received_.size() == 50; });
  for (std::uint8_t i = 0; i < 50; ++i) EXPECT_EQ(received_.at(i), Bytes{i});
}

TEST_F(LiveBus, CarriesAMessageOfManyFragments) {
  receiver_.subscribe("CLOUD", Delivery::queued(100), store());
  Bytes large(150'000);
  std::iota(large.begin(), large.end(), 0);
  const auto complete = [&] { return !received_.empty(); };
  for (int attempt = 0; attempt < 20 && !complete();
       ++attempt) {  // a small socket buffer loses fragments
    sender_.publish("CLOUD", large);
    for (int i = 0; i < 5 && !complete(); ++i) receiver_.handle(20);
  }
  ASSERT_TRUE(complete());
  EXPECT_EQ(received_[0], large);
}

/// Maximum receive buffer of a socket that the kernel permits.
int largest_receive_buffer() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  int bytes = static_cast<int>(kReceiveBufferBytes);
  socklen_t size = sizeof(bytes);
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, size);
  getsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, &size);
  close(socket);
  return bytes;
}

TEST_F(LiveBus, CarriesAMegabyteIfTheKernelBufferHoldsIt) {
  if (largest_receive_buffer() < kReceiveBufferBytes) {
    GTEST_SKIP() << "net.core.rmem_max is small; see deploy/sysctl";
  }
  receiver_.subscribe("CLOUD", Delivery::queued(100), store());
  const Bytes large(1'000'000, 7);
  sender_.publish("CLOUD", large);  // while the receiver does not run
  receive_until([&] { return !received_.empty(); });
  EXPECT_EQ(received_.at(0), large);
}

TEST_F(LiveBus, DeliversTheNewestStateAfterAStall) {
  receiver_.subscribe("POSE", Delivery::latest(), store());
  receiver_.subscribe("IMU", Delivery::queued(100),
                      [](const ReceivedMessage&) { return std::string_view(); });
  for (std::uint8_t i = 0; i < 100; ++i) sender_.publish("POSE", Bytes{i});
  sender_.publish("IMU", {});
  receive_until([&] { return !received_.empty() && received_.back() == Bytes{99}; });
  EXPECT_LT(received_.size(), 100U);
}

/// Lengths of the filters of all receiving sockets of this process.
std::vector<socklen_t> filter_lengths() {
  std::vector<socklen_t> lengths;
  for (const int socket : bound_datagram_sockets()) {
    socklen_t length = 0;  // 0 queries the length
    getsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, nullptr, &length);
    lengths.push_back(length);
  }
  return lengths;
}

TEST_F(LiveBus, DropsUnsubscribedChannelsInTheKernel) {
  receiver_.subscribe("POSE", Delivery::queued(100), store());
  receiver_.subscribe("IMU", Delivery::queued(100), store());
  const auto length = static_cast<socklen_t>(channel_filter({"POSE", "IMU"}).size());
  EXPECT_THAT(filter_lengths(), testing::Contains(length));
  sender_.publish("GAS", Bytes{1});
  sender_.publish("IMU", Bytes{2});
  receive_until([&] { return !received_.empty(); });
  EXPECT_EQ(received_.at(0), Bytes{2});
}

TEST_F(LiveBus, IgnoresDatagramsThatAreNotLcm) {
  receiver_.subscribe("POSE", Delivery::queued(100), store());
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
  receive_until([&] {  // repeatedly, because a full kernel buffer loses some
    sender_.publish("POSE", Bytes{7});
    return !received_.empty();
  });
  EXPECT_EQ(received_.at(0), Bytes{7});
}

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

/// A receiver and an operator with the key; `sender_` is a neighbour without it.
class SealedLiveBus : public LiveBus {
 protected:
  SealedLiveBus() {
    subscribe<mission_order_t>(robot_, channels::kMissionOrder, Delivery::queued(100),
                               [this](const MissionOrder&) { ++orders_; });
    subscribe<stop_t>(robot_, channels::kStop, Delivery::queued(100),
                      [this](const StopOrder& stop) { (stop.stopped ? stops_ : releases_) += 1; });
    subscribe<heartbeat_t>(receiver_, channels::kHeartbeat, Delivery::queued(100),
                           [this](const Heartbeat& heartbeat) { health_ = heartbeat.health; });
  }

  /// Runs both until the condition is true, with `action` in between; fails after ten seconds.
  void run_until(const std::function<bool()>& condition, const std::function<void()>& action) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << "timeout";
      action();
      for (LcmBus* bus : {&robot_, &operator_, &receiver_}) {
        while (bus->handle(1)) {
        }
      }
    }
  }

  static void order(LcmBus& bus) {
    publish(bus, channels::kMissionOrder,
            to_message(MissionOrder{kUtime, MissionOrder::Kind::kResume}));
  }

  SealKey key_ = SealKey::random();
  LcmBus robot_{{.url = "", .seal = key_}};
  NodeHost host_{robot_, {"mission", "1", ""}};
  LcmBus operator_{{.url = "", .seal = key_}};
  int orders_ = 0;
  int stops_ = 0;
  int releases_ = 0;
  Health health_;
};

TEST_F(SealedLiveBus, AcceptsOrdersOfTheOperatorAndCountsThoseOfANeighbour) {
  run_until([&] { return orders_ > 0; }, [&] { order(operator_); });
  const std::int64_t before = robot_.without_valid_seal();
  orders_ = 0;
  for (int i = 0; i < 5; ++i) order(sender_);
  run_until([&] { return robot_.without_valid_seal() == before + 5; }, [] {});
  EXPECT_EQ(orders_, 0);
  run_until([&] { return health_.level == Health::Level::kDegraded; }, [] {});
  EXPECT_EQ(health_.reason, "5 orders without a valid seal were rejected");
}

TEST_F(SealedLiveBus, AcceptsAStopFromAnybodyAndItsReleaseFromTheSealedOnly) {
  const auto stop = [](LcmBus& bus, bool stopped) {
    publish(bus, channels::kStop, to_message(StopOrder{kUtime, stopped, stopped ? "reason" : ""}));
  };
  run_until([&] { return releases_ > 0; }, [&] { stop(operator_, false); });
  releases_ = 0;
  stop(sender_, false);
  stop(sender_, true);
  run_until([&] { return stops_ == 1; }, [] {});
  EXPECT_EQ(releases_, 0);
}

TEST_F(SealedLiveBus, IsReadByWhoHasNoKey) {
  bool is_read = false;
  subscribe<mission_order_t>(receiver_, channels::kMissionOrder, Delivery::queued(100),
                             [&](const MissionOrder&) { is_read = true; });
  run_until([&] { return is_read; }, [&] { order(operator_); });
}

}  // namespace
}  // namespace adit
