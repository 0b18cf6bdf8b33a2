// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/lcm_log.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/log/event_source.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kHeader = 28;
constexpr std::size_t kData = 100;
constexpr std::size_t kEvent = kHeader + 4 + kData;  // channel POSE

std::filesystem::path scratch(const std::string& name) {
  static const test::ScratchFolder folder;
  return folder / name;
}

Bytes read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const Bytes& bytes, const std::filesystem::path& path) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

/// A log of `count` events of kEvent bytes at the times 0, 1, ..
Bytes log_of(int count) {
  const auto path = scratch("complete.lcmlog");
  LogWriter writer(path);
  for (int i = 0; i < count; ++i) {
    writer.write({i, "POSE", Bytes(kData, static_cast<std::uint8_t>(i))});
  }
  writer.close();
  return read(path);
}

struct Parsed {
  std::vector<std::int64_t> utimes;
  LogHealth health;
};

Parsed parse(const Bytes& bytes) {
  Parsed parsed;
  LogParser parser(bytes);
  while (const auto event = parser.next()) parsed.utimes.push_back(event->utime);
  parsed.health = parser.health();
  return parsed;
}

TEST(Log, RestoresWrittenEvents) {
  const std::vector<LogEvent> events{{1'600'000'000'000'000, "POSE", {1, 2, 3}},
                                     {1'600'000'000'000'001, "LASER_FRONT", {}},
                                     {1'600'000'000'000'002, "IMU", Bytes(100'000, 7)}};
  const auto path = scratch("log.lcmlog");
  LogWriter writer(path);
  for (const LogEvent& event : events) writer.write({event.utime, event.channel, event.data});
  writer.close();

  LogFile log(path);
  EXPECT_EQ(log.size(), 3U);
  for (const LogEvent& event : events) {
    const auto read = log.next();
    ASSERT_TRUE(read);
    EXPECT_EQ(
        (LogEvent{read->utime, std::string(read->channel), {read->data.begin(), read->data.end()}}),
        event);
  }
  EXPECT_FALSE(log.next());
  EXPECT_EQ(log.health().corrupt_bytes + log.health().truncated_bytes, 0U);
}

TEST(Log, HasTheLayoutOfLcm) {
  const auto path = scratch("log.lcmlog");
  LogWriter writer(path);
  writer.write({0x0102030405060708, "A", Bytes{9}});
  writer.write({2, "A", Bytes{9}});
  writer.close();
  const Bytes bytes = read(path);
  const Bytes first(bytes.begin(), bytes.begin() + 30);
  EXPECT_EQ(first, (Bytes{0xED, 0xA1, 0xDA, 0x01, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2,   3,
                          4,    5,    6,    7,    8, 0, 0, 0, 1, 0, 0, 0, 1, 'A', 9}));
  EXPECT_EQ(bytes[30 + 11], 1) << "events are numbered";
}

TEST(Log, IsReadInOrderOfTimeAndOfRecording) {
  const auto path = scratch("log.lcmlog");
  LogWriter writer(path);
  writer.write({3, "A", {}});
  writer.write({1, "B", {}});
  writer.write({3, "C", {}});
  writer.write({2, "D", {}});
  writer.close();
  LogFile log(path);
  std::string order;
  while (const auto event = log.next()) order += event->channel;
  EXPECT_EQ(order, "BDAC");
}

TEST(EventList, IsReadInOrderOfTimeAndOfRecording) {
  EventList list({{3, "A", {}}, {1, "B", {}}, {3, "C", {}}, {2, "D", {}}});
  std::string order;
  while (const auto event = list.next()) order += event->channel;
  EXPECT_EQ(order, "BDAC");
}

TEST(Log, MayBeEmpty) {
  const auto path = scratch("log.lcmlog");
  LogWriter(path).close();
  EXPECT_EQ(LogFile(path).size(), 0U);
}

/// A disk that cannot read a part of a log: here the file is truncated after it was opened.
TEST(Log, SkipsEventsThatTheDiskCannotRead) {
  constexpr int kEvents = 1000;
  const auto path = scratch("unreadable.lcmlog");
  write(log_of(kEvents), path);
  LogReader reader(path);
  constexpr std::size_t kReadable = std::size_t{5} * 4096;
  std::filesystem::resize_file(path, kReadable);
  std::int64_t read = 0;
  while (const auto event = reader.next()) {
    EXPECT_EQ(event->utime, read);
    const Bytes data(event->data.begin(), event->data.end());
    EXPECT_EQ(data, Bytes(kData, static_cast<std::uint8_t>(read)));
    ++read;
  }
  EXPECT_EQ(read, kReadable / kEvent);
  const LogHealth health = reader.health();
  EXPECT_EQ(health.events, kReadable / kEvent);
  EXPECT_EQ(health.corrupt_bytes, (kEvents - kReadable / kEvent) * kEvent);
  // The last page of the file is not full.
  EXPECT_EQ(health.unreadable_bytes, kEvents * kEvent / 4096 * 4096 + 4096 - kReadable);
  EXPECT_EQ(damage_warnings(health, "LOG").size(), 2U);
}

TEST(Log, RejectsAFileThatIsNotALogWithItsPath) {
  const auto path = scratch("notes.txt");
  write(Bytes(1000, 'x'), path);
  try {
    const LogFile log(path);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), path.string() + ": not an LCM log");
  }
  EXPECT_THROW(LogFile{scratch("missing.lcmlog")}, std::runtime_error);
  EXPECT_THROW(LogFile{testing::TempDir()}, std::runtime_error);
}

TEST(LogWriter, ThrowsIfItCannotWrite) {
  EXPECT_THROW(LogWriter(scratch("no/such/folder.lcmlog")), std::runtime_error);
  LogWriter full("/dev/full");
  full.write({0, "POSE", Bytes(10)});
  EXPECT_THROW(full.close(), std::runtime_error);
}

TEST(LogParser, FindsTheNextEventAfterDamage) {
  Bytes bytes = log_of(5);
  std::fill_n(bytes.begin() + kEvent, kEvent, std::uint8_t{0x55});
  const Parsed parsed = parse(bytes);
  EXPECT_THAT(parsed.utimes, ElementsAre(0, 2, 3, 4));
  EXPECT_EQ(parsed.health.corrupt_bytes, kEvent);
  EXPECT_EQ(parsed.health.corrupt_regions, 1U);
}

TEST(LogParser, SkipsAnEventWithADamagedSyncWord) {
  Bytes bytes = log_of(3);
  bytes[kEvent] ^= 1U;
  const Parsed parsed = parse(bytes);
  EXPECT_THAT(parsed.utimes, ElementsAre(0, 2));
  EXPECT_EQ(parsed.health.corrupt_bytes, kEvent);
}

TEST(LogParser, IgnoresALengthThatSpansLaterEvents) {
  Bytes bytes = log_of(5);
  bytes[kEvent + 26] = 1;  // 256 bytes more
  const Parsed parsed = parse(bytes);
  EXPECT_THAT(parsed.utimes, ElementsAre(0, 2, 3, 4));
}

TEST(LogParser, IgnoresALengthBeyondTheEnd) {
  for (const std::uint8_t high : {0x7F, 0xFF}) {
    Bytes bytes = log_of(3);
    bytes[kEvent + 24] = high;
    EXPECT_THAT(parse(bytes).utimes, ElementsAre(0, 2));
    bytes = log_of(3);
    bytes[kEvent + 20] = high;  // length of the channel
    EXPECT_THAT(parse(bytes).utimes, ElementsAre(0, 2));
  }
}

TEST(LogParser, ReadsPastASyncWordInTheData) {
  Bytes bytes = log_of(3);
  const Bytes sync{0xED, 0xA1, 0xDA, 0x01};
  std::copy(sync.begin(), sync.end(), bytes.begin() + kEvent + 60);
  EXPECT_THAT(parse(bytes).utimes, ElementsAre(0, 1, 2));
}

TEST(LogParser, ReportsATruncatedTail) {
  const Bytes complete = log_of(3);
  for (std::size_t size = 2 * kEvent + 1; size < complete.size(); ++size) {
    const Parsed parsed =
        parse({complete.begin(), complete.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_THAT(parsed.utimes, ElementsAre(0, 1));
    EXPECT_EQ(parsed.health.truncated_bytes, size - 2 * kEvent);
    EXPECT_EQ(parsed.health.corrupt_bytes, 0U);
  }
}

TEST(LogParser, AccountsForEveryByte) {
  const Bytes complete = log_of(4);
  for (std::size_t at = 0; at < complete.size(); ++at) {
    Bytes bytes = complete;
    bytes[at] ^= 0xFFU;
    const Parsed parsed = parse(bytes);
    EXPECT_GE(parsed.utimes.size(), 3U) << at;
    EXPECT_EQ(
        parsed.health.events * kEvent + parsed.health.corrupt_bytes + parsed.health.truncated_bytes,
        complete.size())
        << at;
  }
}

}  // namespace
}  // namespace adit
