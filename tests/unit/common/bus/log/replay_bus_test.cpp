// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/replay_bus.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/node/node_host.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

std::vector<LogEvent> scans(int count) {
  std::vector<LogEvent> events;
  events.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    events.push_back({kStart + i * kSecond / 10, "LASER_FRONT", {static_cast<std::uint8_t>(i)}});
  }
  return events;
}

std::filesystem::path scratch(const std::string& name) {
  static const test::ScratchFolder folder;
  return folder / name;
}

/// A stage that publishes a pose for each scan.
void answer_scans(Bus& bus) {
  bus.subscribe("LASER_FRONT", Delivery::queued(10),
                [&bus](const ReceivedMessage& received) -> std::string_view {
                  bus.publish("POSE", received.bytes);
                  return {};
                });
}

std::string replayed(const std::vector<LogEvent>& events, const std::filesystem::path& path) {
  EventList source(events);
  LogWriter output(path);
  ReplayBus bus(source, &output);
  NodeHost host(bus, {"scan_matching", "0.1.0", "a: 1\n"});
  answer_scans(host.bus());
  bus.run();
  output.close();
  return test::contents(path);
}

TEST(ReplayBus, DeliversInOrderOfTime) {
  EventList source({{30, "POSE", {3}}, {10, "POSE", {1}}, {20, "POSE", {2}}});
  ReplayBus bus(source, nullptr);
  std::vector<int> order;
  bus.subscribe("POSE", Delivery::latest(),
                [&](const ReceivedMessage& received) -> std::string_view {
                  order.push_back(received.bytes[0]);
                  EXPECT_EQ(bus.now_utime(), 10 * received.bytes[0]);
                  return {};
                });
  bus.run();
  EXPECT_THAT(order, ElementsAre(1, 2, 3));
}

TEST(ReplayBus, GivesTheSameBytesTwice) {
  const std::string once = replayed(scans(200), scratch("once.lcmlog"));
  EXPECT_EQ(once, replayed(scans(200), scratch("twice.lcmlog")));
  EXPECT_FALSE(once.empty());
}

TEST(ReplayBus, GivesTheSameBytesFromShuffledEvents) {
  std::vector<LogEvent> shuffled = scans(200);
  std::reverse(shuffled.begin(), shuffled.end());
  EXPECT_EQ(replayed(scans(200), scratch("once.lcmlog")),
            replayed(shuffled, scratch("twice.lcmlog")));
}

TEST(ReplayBus, StampsOutputsWithTheTimeOfTheirInput) {
  EventList source(scans(3));
  LogWriter output(scratch("out.lcmlog"));
  ReplayBus bus(source, &output);
  answer_scans(bus);
  bus.run();
  output.close();

  LogFile log(scratch("out.lcmlog"));
  for (const LogEvent& scan : scans(3)) {
    const auto input = log.next();
    EXPECT_EQ(input->channel, "LASER_FRONT");
    EXPECT_EQ(input->utime, scan.utime);
    const auto answer = log.next();
    EXPECT_EQ(answer->channel, "POSE");
    EXPECT_EQ(answer->utime, scan.utime);
    EXPECT_EQ(answer->data[0], scan.data[0]);
  }
  EXPECT_FALSE(log.next());
}

TEST(ReplayBus, OmitsChannelsThatStagesPublishAgain) {
  const std::string once = replayed(scans(200), scratch("once.lcmlog"));
  LogFile source(scratch("once.lcmlog"));
  LogWriter output(scratch("twice.lcmlog"));
  ReplayBus bus(source, &output, {{"POSE", "CONFIG", "HEARTBEAT", "STAGE_STATS"}});
  NodeHost host(bus, {"scan_matching", "0.1.0", "a: 1\n"});
  answer_scans(host.bus());
  bus.run();
  output.close();
  std::ifstream file(scratch("twice.lcmlog"), std::ios::binary);
  EXPECT_EQ(once, std::string(std::istreambuf_iterator<char>(file), {}));
}

TEST(ReplayBus, ReplaysForeignChannels) {
  EventList source({{10, "video-front.raw", {1}}});
  LogWriter output(scratch("out.lcmlog"));
  ReplayBus(source, &output).run();
  output.close();
  EXPECT_EQ(LogFile(scratch("out.lcmlog")).next()->channel, "video-front.raw");
}

TEST(ReplayBus, OmitsEventsWithImplausibleTimes) {
  EventList source({{-5, "POSE", {}}, {10, "POSE", {}}, {INT64_MAX, "POSE", {}}});
  ReplayBus bus(source, nullptr);
  bus.run();
  EXPECT_EQ(bus.rejected_events(), 2U);
  EXPECT_EQ(bus.now_utime(), 10);
}

TEST(ReplayBus, ReportsProgress) {
  EventList source(scans(4));
  ReplayBus bus(source, nullptr);
  std::vector<double> shares;
  bus.run([&](double share) { shares.push_back(share); });
  EXPECT_THAT(shares, ElementsAre(0.25, 0.5, 0.75, 1.0));
}

}  // namespace
}  // namespace adit
