// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/topic_board.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

bool everybody(TopicId) { return true; }
bool nobody(TopicId) { return false; }

TEST(TopicBoard, EncodesOnlyWhatIsWantedAndDue) {
  TopicBoard board;
  int encoded = 0;
  const TopicId pose = board.add({.name = "/pose", .period_us = 100}, [&] {
    ++encoded;
    return std::to_string(encoded);
  });
  board.set_changed(pose, 5);
  EXPECT_TRUE(board.take_due(1000, nobody).empty());
  EXPECT_EQ(encoded, 0);

  const auto updates = board.take_due(1000, everybody);
  ASSERT_EQ(updates.size(), 1U);
  EXPECT_EQ(*updates[0].message.bytes, "1");
  EXPECT_EQ(updates[0].message.utime, 5);

  EXPECT_TRUE(board.take_due(2000, everybody).empty()) << "nothing has changed";
  board.set_changed(pose, 6);
  EXPECT_TRUE(board.take_due(1050, everybody).empty()) << "the period has not elapsed";
  EXPECT_EQ(board.take_due(1100, everybody).size(), 1U);
}

TEST(TopicBoard, GivesANewClientTheNewestContent) {
  TopicBoard board;
  std::string content = "a";
  const TopicId map = board.add({.name = "/map"}, [&] { return content; });
  EXPECT_TRUE(board.current(map).empty()) << "no content yet";
  board.set_changed(map, 1);
  ASSERT_EQ(board.current(map).size(), 1U);
  content = "b";
  board.set_changed(map, 2);
  ASSERT_EQ(board.current(map).size(), 1U);
  EXPECT_EQ(*board.current(map)[0].bytes, "b");
}

TEST(TopicBoard, KeepsAppendedMessagesAndReplacesThoseOfOneKey) {
  TopicBoard board;
  const TopicId scans = board.add({.name = "/scans"});
  board.append(scans, 1, "1", "scan 1");
  board.append(scans, 2, "2", "scan 2");
  board.append(scans, 3, "1 with a plan", "scan 1");
  EXPECT_EQ(board.take_due(0, everybody).size(), 3U);
  EXPECT_TRUE(board.take_due(0, everybody).empty());
  const auto kept = board.current(scans);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(*kept[0].bytes, "1 with a plan");
}

TEST(TopicBoard, BoundsWhatItKeeps) {
  TopicBoard board;
  const TopicId events = board.add({.name = "/events"});
  for (std::size_t i = 0; i < TopicBoard::kAppendedMax + 3; ++i) {
    board.append(events, 0, std::to_string(i));
  }
  const auto kept = board.current(events);
  ASSERT_EQ(kept.size(), TopicBoard::kAppendedMax);
  EXPECT_EQ(*kept.front().bytes, "3");
}

}  // namespace
}  // namespace adit
