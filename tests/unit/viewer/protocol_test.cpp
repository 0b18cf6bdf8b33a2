// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/protocol.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace adit::foxglove_protocol {
namespace {

using nlohmann::json;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(FoxgloveProtocol, ReadsSubscriptions) {
  const auto request = parse_text(
      R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":3},{"id":8,"channelId":0}]})");
  ASSERT_TRUE(request) << request.rejection();
  const auto& entries = std::get<Subscribe>(*request).entries;
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].subscription, 7U);
  EXPECT_EQ(entries[0].channel, 3U);
}

TEST(FoxgloveProtocol, RejectsWhatIsNotARequest) {
  for (const char* text :
       {"", "{", "[]", "3", R"({"op":1})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[7]})",
        R"({"op":"unsubscribe","subscriptionIds":["a"]})"}) {
    EXPECT_FALSE(parse_text(text)) << text;
  }
}

TEST(FoxgloveProtocol, BoundsTheEntriesOfAMessage) {
  json request{{"op", "subscribe"}, {"subscriptions", json::array()}};
  for (std::size_t i = 0; i <= kEntriesMax; ++i) {
    request["subscriptions"].push_back({{"id", i}, {"channelId", 0}});
  }
  EXPECT_FALSE(parse_text(request.dump()));
}

TEST(FoxgloveProtocol, NamesOperationsThatItDoesNotSupport) {
  const auto request = parse_text(R"({"op":"setParameters","parameters":[]})");
  ASSERT_TRUE(request);
  EXPECT_EQ(std::get<Unsupported>(*request).operation, "setParameters");
}

TEST(FoxgloveProtocol, ReadsServiceCalls) {
  const std::string bytes("\x02\x01\x00\x00\x00\x09\x00\x00\x00\x04\x00\x00\x00json{}", 19);
  const auto request = parse_binary(bytes_of(bytes));
  ASSERT_TRUE(request) << request.rejection();
  const auto& call = std::get<ServiceCall>(*request);
  EXPECT_EQ(call.service, 1U);
  EXPECT_EQ(call.call, 9U);
  EXPECT_EQ(call.encoding, "json");
  EXPECT_EQ(call.payload, "{}");
}

TEST(FoxgloveProtocol, ReadsPlaybackControl) {
  // Pause, speed 2, seek to 1 s, request "a".
  const std::string bytes(
      "\x03\x01\x00\x00\x00\x40\x01\x00\xca\x9a\x3b\x00\x00\x00\x00\x01\x00\x00\x00"
      "a",
      20);
  const auto request = parse_binary(bytes_of(bytes));
  ASSERT_TRUE(request) << request.rejection();
  const auto& control = std::get<PlaybackControl>(*request);
  EXPECT_FALSE(control.play);
  EXPECT_EQ(control.speed, 2.0);
  EXPECT_EQ(control.seek_ns, 1'000'000'000);
  EXPECT_EQ(control.request_id, "a");
}

TEST(FoxgloveProtocol, RejectsEveryTruncatedBinaryMessage) {
  const std::string call("\x02\x01\x00\x00\x00\x09\x00\x00\x00\x04\x00\x00\x00json", 17);
  for (std::size_t length = 0; length < call.size(); ++length) {
    EXPECT_FALSE(parse_binary(bytes_of(call.substr(0, length)))) << length;
  }
  const std::string control("\x03\x00\x00\x00\x80\x3f\x00\x00\x00\x00\x00\x00\x00\x00\x00", 15);
  EXPECT_TRUE(parse_binary(bytes_of(control)));
  for (std::size_t length = 0; length < control.size(); ++length) {
    EXPECT_FALSE(parse_binary(bytes_of(control.substr(0, length)))) << length;
  }
}

TEST(FoxgloveProtocol, RejectsSpeedsThatAreNotPositive) {
  const std::string nan("\x03\x00\x00\x00\xc0\x7f\x00\x00\x00\x00\x00\x00\x00\x00\x00", 15);
  const std::string zero("\x03\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00", 15);
  EXPECT_FALSE(parse_binary(bytes_of(nan)));
  EXPECT_FALSE(parse_binary(bytes_of(zero)));
}

TEST(FoxgloveProtocol, WritesTheHeaderOfAMessage) {
  EXPECT_EQ(message_header(5, 258),
            std::string("\x01\x05\x00\x00\x00\x02\x01\x00\x00\x00\x00\x00\x00", 13));
}

TEST(FoxgloveProtocol, StatesTheTimesOfALog) {
  const json info = json::parse(server_info_text({.name = "adit",
                                                  .capabilities = {"time"},
                                                  .metadata = {{"source", "log"}},
                                                  .session = "1",
                                                  .time_range = {{1, 2}}}));
  EXPECT_EQ(info["op"], "serverInfo");
  EXPECT_EQ(info["dataStartTime"], 1);
  EXPECT_EQ(info["dataEndTime"], 2);
  EXPECT_EQ(info["metadata"]["source"], "log");
}

TEST(FoxgloveProtocol, WritesJsonOfBytesThatAreNotUtf8) {
  const json status = json::parse(status_text(StatusLevel::kWarning, "\xff\xfe"));
  EXPECT_EQ(status["level"], 1);
}

}  // namespace
}  // namespace adit::foxglove_protocol
