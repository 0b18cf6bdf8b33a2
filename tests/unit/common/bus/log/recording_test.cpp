// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/recording.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

const std::vector<std::uint8_t> kPayload(1000);

std::vector<LogEvent> events_in(const std::filesystem::path& path) {
  LogFile file(path);
  std::vector<LogEvent> events;
  while (const auto event = file.next())
    events.push_back(
        {event->utime, std::string(event->channel), {event->data.begin(), event->data.end()}});
  return events;
}

TEST(Recording, ContinuesWithEnoughSpace) {
  const test::ScratchFolder folder;
  Recording recording(folder / "run.lcmlog", 0.0);
  recording.write({1, "POSE", kPayload});
  recording.check_space(2);
  recording.write({3, "POSE", kPayload});
  recording.close();
  EXPECT_EQ(recording.stopped(), "");
  EXPECT_EQ(events_in(folder / "run.lcmlog").size(), 2U);
}

TEST(Recording, EndsWithTheReasonWhenSpaceIsShort) {
  const test::ScratchFolder folder;
  Recording recording(folder / "run.lcmlog", 1e12);
  recording.write({1, "POSE", kPayload});
  recording.check_space(2);
  recording.write({3, "POSE", kPayload});
  EXPECT_EQ(recording.stopped().find("the recording has stopped: "), 0U) << recording.stopped();
  const auto events = events_in(folder / "run.lcmlog");
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events.back().channel, channels::kHeartbeat);
  EXPECT_EQ(events.back().data, recording.heartbeat(2).data);
}

TEST(Recording, StopsWithWholeEventsWhenTheDiskIsFull) {
  const test::ScratchFolder folder;
  Recording recording(folder / "run.lcmlog", 0.0);
  {
    const test::FileSizeLimit limit(30'000);
    for (int i = 0; i < 100; ++i) recording.write({i, "POSE", kPayload});
  }
  EXPECT_NE(recording.stopped().find("cannot write"), std::string::npos) << recording.stopped();
  const auto bytes = std::filesystem::file_size(folder / "run.lcmlog");
  const auto events = events_in(folder / "run.lcmlog");
  EXPECT_GT(events.size(), 15U);  // a buffer less than the disk takes
  EXPECT_EQ(bytes % events.size(), 0U);
}

}  // namespace
}  // namespace adit
