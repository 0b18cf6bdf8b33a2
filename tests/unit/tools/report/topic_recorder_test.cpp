// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/topic_recorder.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/tools/report/embedded_mission.hpp"
#include "tools/report/page/mission_html.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;

class TopicRecorderTest : public testing::Test {
 protected:
  /// Changes /map each second, from second 1 on, and adds an event every tenth.
  void play(int seconds, TopicRecorder::Limits limits) {
    recorder_.begin([&](const Topic&) { return limits; });
    for (int s = 1; s <= seconds; ++s) {
      board_.set_changed(map_, s * kSecondUs);
      if (s % 10 == 0) board_.append(events_, s * kSecondUs, "event");
      recorder_.record(s * kSecondUs);
    }
    recorder_.finish(seconds * kSecondUs);
  }
  [[nodiscard]] std::vector<std::int64_t> seconds_of(TopicId topic) const {
    std::vector<std::int64_t> seconds;
    for (const auto& record : recorder_.records()) {
      if (record.topic == topic) seconds.push_back(record.message.utime / kSecondUs);
    }
    return seconds;
  }

  TopicBoard board_;
  TopicId map_ = board_.add({.name = "/map", .encoding = "json", .period_us = 100},
                            [] { return std::string(100, 'm'); });
  TopicId events_ = board_.add({.name = "/events", .encoding = "json"});
  TopicRecorder recorder_{board_};
};

TEST_F(TopicRecorderTest, KeepsOneMessageInEachInterval) {
  play(25, {10 * kSecondUs, 100'000});
  EXPECT_EQ(seconds_of(map_), (std::vector<std::int64_t>{1, 11, 21, 25}));
  EXPECT_EQ(seconds_of(events_), (std::vector<std::int64_t>{10, 20}));
}

TEST_F(TopicRecorderTest, KeepsTheLastMessageAloneWhereThatIsEnough) {
  play(25, {TopicRecorder::kAtEnd, 100'000});
  EXPECT_EQ(seconds_of(map_), (std::vector<std::int64_t>{25}));
  EXPECT_EQ(seconds_of(events_).size(), 2U);
}

TEST_F(TopicRecorderTest, SpreadsTheBudgetOverAMissionOfAnyLength) {
  play(5000, {kSecondUs, 2000});
  const auto seconds = seconds_of(map_);
  EXPECT_LE(seconds.size(), 20U);
  EXPECT_GE(seconds.size(), 9U);
  EXPECT_EQ(seconds.front(), 1);
  EXPECT_EQ(seconds.back(), 5000);
  for (std::size_t i = 1; i < seconds.size(); ++i) {
    EXPECT_LE(seconds[i] - seconds[i - 1], 1100) << "a gap of more than two intervals";
  }
  EXPECT_EQ(seconds_of(events_).size(), 500U) << "nothing that was appended is dropped";
}

TEST_F(TopicRecorderTest, IsReadFromThePageAsItWasRecorded) {
  play(25, {10 * kSecondUs, 100'000});
  const std::string html = mission_html("<html><body>page</body></html>", "A <mine>",
                                        board_.topics(), recorder_.records());
  EXPECT_EQ(html.find("<html><body>page<script id=\"mission-data\""), 0U);
  EXPECT_TRUE(html.ends_with("</script>\n</body></html>"));
  const test::EmbeddedMission mission = test::embedded_mission(html);
  EXPECT_EQ(mission.header["serverInfo"]["metadata"]["source"], "file");
  EXPECT_EQ(mission.header["serverInfo"]["metadata"]["title"], "A <mine>");
  ASSERT_EQ(mission.of("/map").size(), 4U);
  EXPECT_EQ(mission.of("/map")[1].bytes, std::string(100, 'm'));
  EXPECT_NEAR(mission.of("/map")[1].time_s, 11.0, 1e-9);
  EXPECT_EQ(mission.of("/events").size(), 2U);
}

}  // namespace
}  // namespace adit
