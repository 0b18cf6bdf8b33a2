// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/client_outbox.hpp"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace adit {
namespace {

TopicMessage message(const std::string& text) {
  return {1, std::make_shared<const std::string>(text)};
}

TEST(ClientOutbox, ReplacesTheMessageThatStillWaits) {
  ClientOutbox outbox;
  for (int i = 0; i < 1000; ++i) outbox.push(4, Retention::kLatest, message(std::to_string(i)));
  const auto frame = outbox.pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(*frame->payload, "999");
  EXPECT_FALSE(outbox.pop());
}

TEST(ClientOutbox, SendsAppendedMessagesInOrder) {
  ClientOutbox outbox;
  outbox.push(1, Retention::kAppended, message("a"));
  outbox.push(1, Retention::kAppended, message("b"));
  outbox.push_text("greeting");
  EXPECT_EQ(outbox.pop()->head, "greeting");
  EXPECT_EQ(*outbox.pop()->payload, "a");
  EXPECT_EQ(*outbox.pop()->payload, "b");
}

TEST(ClientOutbox, ServesSubscriptionsInTurn) {
  ClientOutbox outbox;
  std::string order;
  outbox.push(1, Retention::kLatest, message("a"));
  outbox.push(2, Retention::kLatest, message("b"));
  for (int i = 0; i < 4; ++i) {
    const auto frame = outbox.pop();
    ASSERT_TRUE(frame);
    order += *frame->payload;
    const std::uint32_t subscription = *frame->payload == "a" ? 1 : 2;
    outbox.push(subscription, Retention::kLatest, message(*frame->payload));
  }
  EXPECT_EQ(order, "abab");
}

TEST(ClientOutbox, DropsWhatWaitsForASubscription) {
  ClientOutbox outbox;
  outbox.push(1, Retention::kLatest, message("a"));
  outbox.push(2, Retention::kAppended, message("b"));
  outbox.drop(1);
  outbox.drop(2);
  EXPECT_FALSE(outbox.pop());
}

TEST(ClientOutbox, TellsThatAClientHasFallenBehind) {
  ClientOutbox outbox;
  for (std::size_t i = 0; i <= ClientOutbox::kWaitingMax; ++i) {
    EXPECT_FALSE(outbox.overflows());
    outbox.push(1, Retention::kAppended, message(""));
  }
  EXPECT_TRUE(outbox.overflows());
}

}  // namespace
}  // namespace adit
