// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/log_times/time_choice.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/log_times/reorder_buffer.hpp"
#include "tools/log_times/time_assignment.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Source = TimeChoice::Source;

constexpr std::int64_t kStart = 1'018'930'000'123'456;  // an epoch of ten digits
constexpr std::int64_t kPeriodUs = 200'000;
constexpr int kScans = 1000;
constexpr double kStepRad = M_PI / 180.0;
constexpr const char* kLaser = "LASER_FRONT";
constexpr const char* kWheels = "WHEEL_ODOMETRY";

using Clock = std::function<std::int64_t(int)>;

std::int64_t true_utime(int scan) { return kStart + scan * kPeriodUs; }
std::int64_t zero(int /*scan*/) { return 0; }

/// As a stream prints seconds with `digits` significant digits.
std::int64_t with_digits(std::int64_t utime, int digits) {
  const double s = 1e-6 * static_cast<double>(utime);
  const double unit = std::pow(10.0, std::floor(std::log10(s)) + 1 - digits);
  return std::llround(1e6 * unit * std::round(s / unit));
}

/// A robot at 0.5 m/s in a log with these clocks.
TimeJudge judge(const Clock& measured, const Clock& logged) {
  TimeJudge judge;
  for (int i = 0; i < kScans; ++i) {
    const Pose2 T_wheel_body{0.5e-6 * static_cast<double>(i * kPeriodUs), 0.0, 0.0};
    judge.add_scan(kLaser, {measured(i), logged(i)}, kStepRad, &T_wheel_body);
  }
  return judge;
}

TEST(TimeJudge, UsesTheTimesOfMeasurementOfAnIntactLog) {
  const TimeChoice choice = judge(true_utime, true_utime).choose();
  EXPECT_EQ(choice.source, Source::kMeasured);
  EXPECT_EQ(choice.text(), "");
}

TEST(TimeJudge, ToleratesAFewZeroOrEqualTimes) {
  const auto damaged = [](int i) { return i % 20 == 0 ? 0 : true_utime(std::max(i, 5)); };
  EXPECT_EQ(judge(damaged, true_utime).choose().source, Source::kMeasured);
}

TEST(TimeJudge, UsesTheLoggerWhereItIsBetter) {
  const auto since_start = [](int i) { return 86'295 + i * kPeriodUs; };
  for (const Clock& damaged :
       {Clock(zero), Clock([](int i) { return with_digits(true_utime(i), 6); })}) {
    const TimeChoice choice = judge(damaged, since_start).choose();
    EXPECT_EQ(choice.source, Source::kLogged);
    EXPECT_THAT(choice.text(), HasSubstr("times of the logger are used: "));
  }
}

TEST(TimeJudge, AssumesThePeriodOfTheChangesOfACoarseClock) {
  const auto coarse = [](int i) { return with_digits(true_utime(i), 9); };  // 10 s
  const TimeChoice choice = judge(coarse, coarse).choose();
  EXPECT_EQ(choice.source, Source::kOrder);
  EXPECT_NEAR(choice.period_us, kPeriodUs, 0.02 * kPeriodUs);  // a scan in the 50 of a change
  EXPECT_THAT(choice.text(), HasSubstr(" of 1000 repeat the one before"));
  EXPECT_THAT(choice.text(), HasSubstr("0.2 s from scan to scan by the changes of the times"));
}

TEST(TimeJudge, AssumesThePeriodByTheMotionOfTheWheels) {
  const auto coarse = [](int i) { return with_digits(true_utime(i), 6); };  // 10 000 s
  for (const Clock& clock : {Clock(zero), Clock(coarse)}) {
    const TimeChoice choice = judge(clock, clock).choose();
    EXPECT_EQ(choice.source, Source::kOrder);
    EXPECT_NEAR(choice.period_us, kPeriodUs, 1.0);
    EXPECT_THAT(choice.text(), HasSubstr("a robot at 0.5 m/s"));
  }
}

TEST(TimeJudge, AssumesTheRateOfTheLaserOfABodyWithoutOdometry) {
  TimeJudge judge;
  for (int i = 0; i < kScans; ++i) judge.add_scan(kLaser, {}, kStepRad);
  const TimeChoice choice = judge.choose();
  EXPECT_NEAR(choice.period_us, 1e6 / 75.0, 1.0);
  EXPECT_THAT(choice.text(), HasSubstr("1000 of 1000 are zero"));
}

TEST(TimeJudge, TakesThePeriodFromOtherReadingsWithUsableTimes) {
  TimeJudge judge;
  for (int i = 0; i < kScans; ++i) {
    judge.add_scan(kLaser, {}, kStepRad);
    judge.add_reading(kWheels, {true_utime(i) + 1000, 0});
  }
  const TimeChoice choice = judge.choose();
  EXPECT_NEAR(choice.period_us, kPeriodUs, 1.0);
  EXPECT_EQ(choice.period_origin, "the times of WHEEL_ODOMETRY");
}

TEST(TimeJudge, CountsReadingsOutOfOrderAsUsable) {
  const auto exchanged = [](int i) { return true_utime(i ^ 1); };  // neighbours
  const TimeChoice choice = judge(exchanged, exchanged).choose();
  EXPECT_EQ(choice.source, Source::kMeasured);
  EXPECT_EQ(choice.late, 500U);
  EXPECT_EQ(choice.text(), "500 readings out of order are sorted by time");
}

TEST(TimeAssignment, SpreadsReadingsOverTheTimeBetweenScans) {
  TimeChoice choice;
  choice.source = Source::kOrder;
  choice.channel = kLaser;
  choice.start_utime = 10'000'000;
  choice.period_us = 100'000.0;
  choice.readings_per_scan = 3.0;
  TimeAssignment assignment(choice);
  std::vector<std::int64_t> times;
  for (const char* channel :
       {kWheels, kLaser, kWheels, kWheels, kWheels, kWheels, kWheels, kLaser, kLaser}) {
    times.push_back(assignment.next(channel, {}));
  }
  EXPECT_THAT(times, ElementsAre(9'925'000, 10'000'000, 10'025'000, 10'050'000, 10'075'000,
                                 10'080'000, 10'083'333, 10'100'000, 10'200'000));
}

TEST(ReorderBuffer, SortsWithinItsWindow) {
  std::vector<int> output;
  ReorderBuffer<int> buffer([&](int reading) { output.push_back(reading); });
  const auto add = [&](int tenths) { buffer.add(100'000 * tenths, tenths); };
  for (const int tenths : {52, 50, 51, 53, 70}) add(tenths);
  EXPECT_THAT(output, ElementsAre(50, 51, 52, 53));
  add(10);  // the clock was set back
  add(11);
  buffer.flush();
  EXPECT_THAT(output, ElementsAre(50, 51, 52, 53, 70, 10, 11));
}

}  // namespace
}  // namespace adit
