// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Tests the filter in the kernel, on a socket of its own.
#include "common/bus/channel_filter.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/bus/channels.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string message(const std::string& channel, const std::string& payload = {}) {
  return std::string("LC02") + std::string(3, '\0') + '\x07' + channel + '\0' + payload;
}

class ChannelFilter : public testing::Test {
 protected:
  ChannelFilter() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    bind(receiver_, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
    socklen_t size = sizeof(address_);
    getsockname(receiver_, reinterpret_cast<sockaddr*>(&address_), &size);
  }
  ~ChannelFilter() override {
    close(receiver_);
    close(sender_);
  }

  void send(const std::string& datagram) {
    sendto(sender_, datagram.data(), datagram.size(), 0,
           reinterpret_cast<const sockaddr*>(&address_), sizeof(address_));
  }

  /// All datagrams received before an end marker, which is not an LCM datagram.
  std::vector<std::string> received() {
    const std::string last = "the end";
    send(last);
    std::vector<std::string> found;
    for (std::string datagram; datagram != last;) {
      datagram.resize(1000);
      const auto bytes = recv(receiver_, datagram.data(), datagram.size(), 0);
      datagram.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes));
      if (datagram != last) found.push_back(datagram);
    }
    return found;
  }

  int receiver_ = socket(AF_INET, SOCK_DGRAM, 0);
  int sender_ = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address_{};
};

TEST_F(ChannelFilter, PassesSubscribedChannelsOnly) {
  for (const std::string_view subscribed : channels::kAll) {
    attach_channel_filter({std::string(subscribed)}, {receiver_});
    for (const std::string_view channel : channels::kAll) send(message(std::string(channel)));
    EXPECT_THAT(received(), ElementsAre(message(std::string(subscribed))));
  }
}

TEST_F(ChannelFilter, ReportsARejectionByTheKernel) {
  EXPECT_TRUE(attach_channel_filter({"POSE"}, {receiver_}));
  const int none = -1;
  EXPECT_FALSE(attach_channel_filter({"POSE"}, {receiver_, none}));
  Channels many;  // more instructions than the kernel accepts
  for (int i = 0; i < 1000; ++i) many.insert("CHANNEL_" + std::to_string(i));
  EXPECT_FALSE(attach_channel_filter(many, {receiver_}));
  EXPECT_FALSE(attach_channel_filter({"POSE"}, {}));
}

TEST_F(ChannelFilter, DistinguishesNamesWithACommonPrefix) {
  attach_channel_filter({"A", "SIM_TIME", "POSE_GRAPH"}, {receiver_});
  for (const char* channel : {"", "AB", "SIM_TIM", "SIM_TIME_DONE", "POSE", "POSE_GRAPHS"}) {
    send(message(channel));
    send(message(channel, "A payload that is longer than any name of a channel"));
  }
  EXPECT_THAT(received(), IsEmpty());
  for (const char* channel : {"SIM_TIME", "A", "POSE_GRAPH"}) send(message(channel, "1"));
  EXPECT_THAT(received(),
              ElementsAre(message("SIM_TIME", "1"), message("A", "1"), message("POSE_GRAPH", "1")));
}

TEST_F(ChannelFilter, PassesFragments) {
  attach_channel_filter({"POSE"}, {receiver_});
  std::string fragment = "LC03";
  fragment.resize(fragment.size() + 16);
  fragment.append("CLOUD");
  send(fragment);
  EXPECT_THAT(received(), ElementsAre(fragment));
}

TEST_F(ChannelFilter, PassesEverythingWithTooManyChannels) {
  attach_channel_filter({"POSE"}, {receiver_});
  Channels many;
  for (int i = 0; i < 1000; ++i) many.insert("CHANNEL_" + std::to_string(i));
  attach_channel_filter(many, {receiver_});
  send(message("OTHER"));
  EXPECT_THAT(received(), ElementsAre(message("OTHER")));
}

TEST_F(ChannelFilter, FindsTheSocketsOfThisProcess) {
  EXPECT_TRUE(bound_datagram_sockets().contains(receiver_));
  EXPECT_FALSE(bound_datagram_sockets().contains(sender_));
  EXPECT_THAT(bound_datagram_sockets_except(bound_datagram_sockets()), IsEmpty());
}

}  // namespace
}  // namespace adit
