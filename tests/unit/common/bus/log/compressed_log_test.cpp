// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Logs compressed with zstd, read as plain ones are.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/log/recording.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using Events = std::vector<LogEvent>;

/// Events of 10 to 2000 bytes, and one of 3 MB, which is longer than a window of the reader. Their
/// times are in order but for every hundredth.
Events drive(int count) {
  std::mt19937 random(7);
  Events events;
  for (int i = 0; i < count; ++i) {
    std::vector<std::uint8_t> data(i == count / 2 ? 3'000'000 : 10 + random() % 1990);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random() % 20);
    events.push_back({i % 100 == 99 ? i - 50 : i, i % 3 == 0 ? "POSE" : "LASER_FRONT", data});
  }
  return events;
}

LogEvent copy(const LogEventView& event) {
  return {event.utime, std::string(event.channel), {event.data.begin(), event.data.end()}};
}

struct Read {
  Events events;
  LogHealth health;
};

Read read(const std::filesystem::path& path) {
  LogReader reader(path);
  Read result;
  while (const auto event = reader.next()) result.events.push_back(copy(*event));
  result.health = reader.health();
  EXPECT_EQ(reader.fraction_read(), 1.0);
  return result;
}

class CompressedLog : public testing::Test {
 protected:
  void write(const Events& events, const std::string& name) {
    LogWriter writer(folder_ / name);
    for (const LogEvent& event : events) writer.write({event.utime, event.channel, event.data});
    writer.close();
  }
  void store(const std::string& bytes, const std::string& name) {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  test::ScratchFolder folder_;
};

TEST_F(CompressedLog, IsSmallerAndHasTheSameEvents) {
  const Events events = drive(20'000);
  write(events, "run.lcmlog");
  write(events, "run.lcmlog.zst");
  EXPECT_LT(test::contents(folder_ / "run.lcmlog.zst").size(),
            test::contents(folder_ / "run.lcmlog").size() * 7 / 10);
  const Read compressed = read(folder_ / "run.lcmlog.zst");
  EXPECT_EQ(compressed.events, events);
  EXPECT_EQ(compressed.health.events, events.size());
  EXPECT_EQ(compressed.health.corrupt_bytes + compressed.health.truncated_bytes, 0U);

  LogFile sorted(folder_ / "run.lcmlog.zst");
  LogFile plain(folder_ / "run.lcmlog");
  ASSERT_EQ(sorted.size(), plain.size());
  while (const auto event = plain.next()) EXPECT_EQ(copy(*sorted.next()), copy(*event));
}

TEST_F(CompressedLog, IsNotKnownByItsName) {
  const Events events = drive(100);
  write(events, "run.lcmlog.zst");
  std::filesystem::rename(folder_ / "run.lcmlog.zst", folder_ / "run.lcmlog");
  EXPECT_EQ(read(folder_ / "run.lcmlog").events, events);
}

TEST_F(CompressedLog, LosesWhatFollowsACutOnly) {
  const Events events = drive(5'000);
  write(events, "run.lcmlog.zst");
  const std::string whole = test::contents(folder_ / "run.lcmlog.zst");
  std::size_t last = 0;
  for (const double share : {0.1, 0.5, 0.9}) {
    store(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))),
          "cut.lcmlog.zst");
    const Read cut = read(folder_ / "cut.lcmlog.zst");
    EXPECT_GT(cut.events.size(), last);
    last = cut.events.size();
    ASSERT_LT(last, events.size());
    EXPECT_TRUE(std::equal(cut.events.begin(), cut.events.end(), events.begin())) << share;
    EXPECT_GT(cut.health.truncated_bytes, 0U) << share;
    EXPECT_EQ(LogFile(folder_ / "cut.lcmlog.zst").size(), last);
  }
}

TEST_F(CompressedLog, ContinuesBehindDamage) {
  const Events events = drive(20'000);
  write(events, "run.lcmlog.zst");
  std::string damaged = test::contents(folder_ / "run.lcmlog.zst");
  for (std::size_t i = 0; i < 100; ++i) damaged[damaged.size() / 3 + i] = static_cast<char>(i);
  store(damaged, "damaged.lcmlog.zst");
  const Read read_events = read(folder_ / "damaged.lcmlog.zst");
  EXPECT_GT(read_events.events.size(), events.size() / 2);
  EXPECT_LT(read_events.events.size(), events.size());
  EXPECT_EQ(read_events.events.back(), events.back());
  EXPECT_GT(read_events.health.corrupt_bytes, 0U);
  LogFile file(folder_ / "damaged.lcmlog.zst");
  EXPECT_EQ(file.size(), read_events.events.size());
  EXPECT_GT(file.health().corrupt_bytes, 0U);
}

/// As after a kill or a power loss: the writer has no chance to close the log.
TEST_F(CompressedLog, IsReadableWhileItIsWritten) {
  const Events events = drive(2'000);
  LogWriter writer(folder_ / "run.lcmlog.zst");
  for (const LogEvent& event : events) writer.write({event.utime, event.channel, event.data});
  const Read meanwhile = read(folder_ / "run.lcmlog.zst");
  EXPECT_GT(meanwhile.events.size(), events.size() - 300);  // 64 kB of events are not written yet
  EXPECT_TRUE(std::equal(meanwhile.events.begin(), meanwhile.events.end(), events.begin()));
  EXPECT_EQ(meanwhile.health.truncated_bytes, 0U);
}

TEST_F(CompressedLog, EndsWithAWholeEventOnAFullDisk) {
  const Events events = drive(2'000);
  {
    const test::FileSizeLimit limit(200'000);
    Recording recording(folder_ / "run.lcmlog.zst", 0.0);
    for (const LogEvent& event : events) recording.write({event.utime, event.channel, event.data});
    recording.close();
    EXPECT_NE(recording.stopped(), "");
  }
  const Read recorded = read(folder_ / "run.lcmlog.zst");
  EXPECT_GT(recorded.events.size(), 100U);
  EXPECT_TRUE(std::equal(recorded.events.begin(), recorded.events.end(), events.begin()));
  EXPECT_EQ(recorded.health.corrupt_bytes + recorded.health.truncated_bytes, 0U);
}

TEST_F(CompressedLog, HasTheSameBytesForTheSameEvents) {
  write(drive(3'000), "a.lcmlog.zst");
  write(drive(3'000), "b.lcmlog.zst");
  EXPECT_TRUE(test::contents(folder_ / "a.lcmlog.zst") == test::contents(folder_ / "b.lcmlog.zst"));
}

TEST_F(CompressedLog, LeavesNothingBesideItWhenItIsRead) {
  write(drive(100), "run.lcmlog.zst");
  LogFile(folder_ / "run.lcmlog.zst").next();
  const std::filesystem::directory_iterator files(folder_.path());
  EXPECT_EQ(std::distance(files, {}), 1);
}

}  // namespace
}  // namespace adit
