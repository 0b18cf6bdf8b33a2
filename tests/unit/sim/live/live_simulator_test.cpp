// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/live_simulator.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/sim.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kAheadMaxUs = 200'000;  // the default

LiveRunOptions options_waiting_for(const std::vector<std::string>& stages) {
  LiveRunOptions options;
  options.program = "test";
  options.pacing = {.factor = {}, .wait_for = stages};
  options.for_s = 1.0;
  return options;
}

class LiveSimulatorTest : public testing::Test {
 protected:
  LiveSimulatorTest() {
    subscribe<sim_time_t>(bus_, channels::kSimTime, Delivery::queued(1000),
                          [this](const SimTime& time) { times_.push_back(time.utime - kStart); });
  }

  LiveSimulator simulator(const std::vector<std::string>& stages) {
    return {bus_, site_, {}, {}, options_waiting_for(stages), kStart};
  }
  void answer(std::int64_t utime) {
    publish(bus_, channels::kSimTimeDone, to_message(SimTimeDone{utime, "mapping"}));
  }

  Site site_{box_tunnel()};
  MemoryBus bus_;
  std::vector<std::int64_t> times_;  // that were sent, since the start
};

TEST_F(LiveSimulatorTest, RunsForItsDuration) {
  LiveSimulator simulator = this->simulator({});
  while (!simulator.done()) simulator.advance(0);
  EXPECT_EQ(times_.size(), 21U);  // each 50 ms, the start as well
  EXPECT_EQ(times_.back(), kSecond);
}

TEST_F(LiveSimulatorTest, WaitsForTheSelectedStages) {
  LiveSimulator simulator = this->simulator({"mapping"});
  const auto advance = [&] {
    for (int i = 0; i < 100; ++i) simulator.advance(0);
  };
  advance();
  EXPECT_EQ(times_.back(), 0);
  answer(kStart);
  advance();
  EXPECT_EQ(times_.back(), kAheadMaxUs);
  answer(kStart + kSecond);  // of a time that it has not published: an answer to another simulator
  advance();
  EXPECT_EQ(times_.back(), kAheadMaxUs);
  answer(kStart + kAheadMaxUs);
  advance();
  EXPECT_EQ(times_.back(), 2 * kAheadMaxUs);
}

TEST_F(LiveSimulatorTest, RepeatsTheTimeForAStageThatStartsLate) {
  LiveSimulator simulator = this->simulator({"mapping"});
  times_.clear();
  for (int ms = 1; ms <= 1100; ++ms) simulator.advance(kSecond + ms * 1000);
  EXPECT_THAT(times_, ElementsAre(0, 0, 0));  // twice a second
}

TEST_F(LiveSimulatorTest, RecordsAllMessagesInOrder) {
  const test::ScratchFolder scratch;
  LiveRunOptions options = options_waiting_for({});
  options.record = scratch / "run.lcmlog";
  std::vector<LogEvent> published;
  bus_.tap([&](const ReceivedMessage& message) {
    published.push_back(
        {0, std::string(message.channel), {message.bytes.begin(), message.bytes.end()}});
  });
  LiveSimulator simulator(bus_, site_, {}, {}, options, kStart);
  while (!simulator.done()) simulator.advance(0);
  simulator.close_record();

  const LogFile log(options.record);
  ASSERT_EQ(log.events().size(), published.size());
  EXPECT_GT(published.size(), 300U);  // of IMU, lasers and all else in a second
  for (std::size_t i = 0; i < published.size(); ++i) {
    const LogEventView& event = log.events()[i];
    EXPECT_EQ(event.channel, published[i].channel);
    EXPECT_TRUE(std::ranges::equal(event.data, published[i].data));
  }
  EXPECT_EQ(log.events().front().utime, kStart);
  EXPECT_EQ(log.events().back().utime, kStart + kSecond);
}

TEST_F(LiveSimulatorTest, DoesNotRecordTheAnswersOfStages) {
  const test::ScratchFolder scratch;
  LiveRunOptions options = options_waiting_for({});
  options.record = scratch / "run.lcmlog";
  LiveSimulator simulator(bus_, site_, {}, {}, options, kStart);
  answer(kStart);
  while (!simulator.done()) simulator.advance(0);
  simulator.close_record();
  LogReader log(options.record);
  std::set<std::string> recorded;
  while (const auto event = log.next()) recorded.emplace(event->channel);
  EXPECT_TRUE(recorded.contains("SIM_TIME"));
  EXPECT_FALSE(recorded.contains("SIM_TIME_DONE"));
}

TEST_F(LiveSimulatorTest, ReportsAStageThatDoesNotAnswer) {
  LiveSimulator simulator = this->simulator({"mapping"});
  testing::internal::CaptureStderr();
  simulator.advance(0);
  simulator.advance(Pacing::kStageTimeoutUs);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("waiting for mapping"));
}

TEST(ProgressLine, ReportsTheStateOfTheRun) {
  const VehicleState driving{kStart, 0.4, 0.0, 0.9, false, false};
  EXPECT_EQ(progress_line(83.42, 7.94, {kStart, 31.24, ""}, driving),
            "83.4 s simulated, 7.9 x real time, 31.2 m, driving");
  EXPECT_THAT(progress_line(1.0, 1.0, {kStart, 1.0, "hit a post"}, driving),
              HasSubstr("failed: hit a post"));
}

}  // namespace
}  // namespace adit
