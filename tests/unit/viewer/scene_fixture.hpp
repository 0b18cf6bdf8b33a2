// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "viewer/scene/scene.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// A scene on a bus in memory, and what its topics hold.
class SceneFixture : public testing::Test {
 protected:
  static constexpr std::int64_t kStartUs = 1'700'000'000'000'000;

  template <class Value>
  void send(std::string_view channel, const Value& value) {
    bus_.inject(bus_.now_utime() == 0 ? kStartUs : bus_.now_utime(), channel,
                encode(to_message(value)));
  }
  /// Sends the fragments of an object.
  template <class Object>
  void send_object(std::string_view channel, const Object& object) {
    for (const auto& fragment : split(object)) send(channel, fragment);
  }

  /// The messages that a new client gets.
  std::vector<TopicMessage> messages(std::string_view name) {
    for (TopicId topic = 0; topic < board_.topics().size(); ++topic) {
      if (board_.topics()[topic].name == name) return board_.current(topic);
    }
    ADD_FAILURE() << "no topic " << name;
    return {};
  }
  /// The newest message; empty if there is none.
  std::string newest(std::string_view name) {
    const auto all = messages(name);
    return all.empty() ? "" : *all.back().bytes;
  }
  template <class Message>
  Message newest_of(std::string_view name) {
    Message message;
    EXPECT_TRUE(message.ParseFromString(newest(name))) << name;
    return message;
  }
  nlohmann::json newest_json(std::string_view name) {
    return nlohmann::json::parse(newest(name), nullptr, false);
  }

  MemoryBus bus_;
  TopicBoard board_;
  Scene scene_{bus_, board_, SceneParameters{}};
};

}  // namespace adit
