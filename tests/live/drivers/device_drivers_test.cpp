// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The processes of drivers of other devices than lasers, with emulated ones on a pseudo-terminal,
// and LCM.
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "tests/live/drivers/live_driver.hpp"
#include "tests/support/devices/base_emulator.hpp"
#include "tests/support/devices/imu_emulator.hpp"
#include "tests/support/devices/servo_emulator.hpp"
#include "tests/support/lasers/pty_line.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using Level = Health::Level;

constexpr double kStampErrorMaxMs = 10.0;

constexpr double kTicksPerM = 5000.0;

/// With a command each 50 ms and an order of the guard each 100 ms while `speed_m_s` is set.
class LiveBase : public LiveDriver<PtyLaser<BaseEmulator>> {
 public:
  LiveBase(BaseEmulator& base, PtyLaser<BaseEmulator>& line) : LiveDriver(line), base_(base) {
    subscribe<wheel_odometry_t>(bus(), channels::kWheelOdometry, Delivery::queued(1000),
                                [this](const wheel_odometry_t& odometry) { check(odometry); });
    subscribe<vehicle_state_t>(bus(), channels::kVehicleState, Delivery::queued(1000),
                               [this](const VehicleState& vehicle) { state = vehicle; });
    bus().create_timer(50'000, [this](std::int64_t utime) {
      if (speed_m_s) {
        publish(bus(), channels::kDriveCommand, to_message(DriveCommand{utime, *speed_m_s, 0.0}));
        publish(bus(), channels::kStop, to_message(StopOrder{utime, false, {}}));
      }
    });
  }

  std::optional<double> speed_m_s;
  std::optional<VehicleState> state;
  double x_m = 0.0;

 private:
  /// On a straight path; the ticks of the base at the stamp are the truth.
  void check(const wheel_odometry_t& odometry) {
    ++readings;
    x_m = odometry.x_m;
    const auto ticks = base_.ticks_at(odometry.utime);
    const double off_m = odometry.x_m - (ticks[0] + ticks[1]) / 2.0 / kTicksPerM;
    if (readings > 1 && std::abs(off_m - off_m_) > 0.5 * 1e-3 * kStampErrorMaxMs) ++wrong;
    off_m_ = off_m;
    if (std::abs(odometry.forward_m_s) > 0.1) add_stamp_error(1e3 * off_m / odometry.forward_m_s);
  }

  BaseEmulator& base_;
  double off_m_ = 0.0;
};

TEST(BaseSerialLive, DrivesAndStopsThroughAllThatHappensToABase) {
  const test::ScratchFolder folder;
  BaseEmulator base({.boot_s = 0.2});
  PtyLaser<BaseEmulator> line(folder / "base", base);
  LiveBase live(base, line);
  live.start(ADIT_BASE_SERIAL, "",
             fmt::format("base_serial: {{device: {}}}\n", (folder / "base").string()));
  ASSERT_TRUE(live.has_health(Level::kFault));
  EXPECT_EQ(live.readings, 0);

  base.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;
  EXPECT_TRUE(live.state->expired);
  live.speed_m_s = 0.5;
  ASSERT_TRUE(live.more_readings_arrive(100));
  EXPECT_LT(live.core_share(250), kBusyLoopShare);
  EXPECT_LT(std::abs(live.stamp_error_ms()), kStampErrorMaxMs);
  EXPECT_TRUE(live.run_until(
      [&] { return !live.state->expired && std::abs(live.state->speed_m_s - 0.5) < 0.02; }));
  EXPECT_EQ(live.check_driver(ADIT, "WHEEL_ODOMETRY"), 0);
  EXPECT_EQ(live.check_driver(ADIT, "VEHICLE_STATE"), 0);

  publish(live.bus(), channels::kStop, to_message(StopOrder{wall_utime(), true, "test"}));
  const std::int64_t ordered_us = steady_us();
  ASSERT_TRUE(live.run_until([&] { return base.brakes(); }));
  fmt::print("brakes {:.1f} ms behind the order\n", 1e-3 * (steady_us() - ordered_us));
  ASSERT_TRUE(live.run_until([&] { return !base.brakes() && live.state->speed_m_s > 0.4; }));
  live.speed_m_s.reset();
  ASSERT_TRUE(live.run_until([&] { return live.state->expired && live.state->speed_m_s == 0.0; }));
  live.speed_m_s = 0.5;
  ASSERT_TRUE(live.run_until([&] { return live.state->speed_m_s > 0.4; }));

  line.corrupt_share = 0.01;
  ASSERT_TRUE(live.more_readings_arrive(100));
  line.corrupt_share = 0.0;
  EXPECT_EQ(live.wrong, 0);

  live.driver().suspend();  // the computer hangs: the base brakes by itself
  ASSERT_TRUE(live.run_until([&] { return base.is_expired() && base.speeds_ticks_s()[0] == 0.0; }));
  live.driver().resume();
  ASSERT_TRUE(live.run_until([&] { return live.state->speed_m_s > 0.4; }));

  const double x_m = live.x_m;
  base.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault));
  base.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(50));
  EXPECT_GT(live.x_m, x_m);

  line.line().unplug();
  ASSERT_TRUE(live.has_health(Level::kFault, "base"));
  ASSERT_TRUE(live.run_until([&] { return base.is_expired(); }));
  line.line().plug();
  ASSERT_TRUE(live.more_readings_arrive(50));
  EXPECT_TRUE(live.has_health(Level::kDegraded, "gaps since the start")) << live.health->reason;
  EXPECT_EQ(live.driver().terminate(), 0);
}

/// Angles are wrong that are not what the servo measured for one of its last answers.
class LiveTilt : public LiveDriver<PtyLaser<ServoEmulator>> {
 public:
  LiveTilt(ServoEmulator& servo, PtyLaser<ServoEmulator>& line) : LiveDriver(line), servo_(servo) {
    subscribe<tilt_t>(bus(), channels::kTiltRear, Delivery::queued(1000),
                      [this](const TiltReading& reading) { check(reading); });
  }

  void command(double goal_rad) {
    publish(bus(), channels::kTiltCommandRear,
            to_message(TiltCommand{wall_utime(), goal_rad, 0.5}));
  }

  double angle_rad = 0.0;

 private:
  void check(const TiltReading& reading) {
    ++readings;
    angle_rad = reading.angle_rad;
    constexpr double kRadPerPosition = 2.0 * std::numbers::pi / 4096.0;
    std::optional<double> nearest_ms;
    for (const auto& sample : servo_.samples()) {
      const double off_rad = reading.angle_rad - (sample.position - 2048.0) * kRadPerPosition;
      const double off_ms = 1e-3 * static_cast<double>(reading.utime - sample.utime);
      if (std::abs(off_rad) > 0.51 * kRadPerPosition) continue;
      if (!nearest_ms || std::abs(off_ms) < std::abs(*nearest_ms)) nearest_ms = off_ms;
    }
    if (nearest_ms) {
      add_stamp_error(*nearest_ms);
    } else {
      ++wrong;
    }
  }

  ServoEmulator& servo_;
};

TEST(TiltLive, TiltsALaserThroughAllThatHappensToAServo) {
  const test::ScratchFolder folder;
  ServoEmulator servo({.baud = 115200, .boot_s = 0.2, .position = 2100.0});
  PtyLaser<ServoEmulator> line(folder / "servo", servo);
  LiveTilt live(servo, line);
  live.start(ADIT_TILT, "rear",
             fmt::format("tilt_rear: {{device: {}}}\n", (folder / "servo").string()));
  ASSERT_TRUE(live.has_health(Level::kFault));
  EXPECT_EQ(live.readings, 0);

  servo.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;
  live.command(0.4);
  ASSERT_TRUE(live.run_until([&] { return std::abs(live.angle_rad - 0.4) < 0.002; }));
  live.command(-0.4);
  EXPECT_LT(live.core_share(100), kBusyLoopShare);
  EXPECT_LT(std::abs(live.stamp_error_ms()), kStampErrorMaxMs);
  EXPECT_EQ(live.check_driver(ADIT, "TILT_REAR"), 0);

  line.corrupt_share = 0.01;
  ASSERT_TRUE(live.more_readings_arrive(100));
  line.corrupt_share = 0.0;

  servo.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault));
  servo.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(50));
  EXPECT_TRUE(servo.torque());

  line.line().unplug();
  ASSERT_TRUE(live.has_health(Level::kFault, "servo"));
  line.line().plug();
  ASSERT_TRUE(live.more_readings_arrive(50));
  EXPECT_TRUE(live.has_health(Level::kDegraded, "gaps since the start")) << live.health->reason;
  EXPECT_EQ(live.wrong, 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

/// The rate about x tells the number of the reading.
class LiveImu : public LiveDriver<PtyLaser<ImuEmulator>> {
 public:
  LiveImu(ImuEmulator& unit, PtyLaser<ImuEmulator>& line) : LiveDriver(line), unit_(unit) {
    subscribe<imu_t>(bus(), channels::kImu, Delivery::queued(1000),
                     [this](const ImuReading& reading) { check(reading); });
  }

  static std::array<double, 6> reading(int number) {
    return {0.1, -0.2, -9.81, 1e-5 * (number % 100'000), 0.001 * (number % 7), -0.3};
  }

 private:
  void check(const ImuReading& reading) {
    ++readings;
    const auto number = static_cast<int>(std::lround(1e5 * reading.angular_velocity.x()));
    const int index = number - unit_.first_number();
    const bool is_right = index >= 0 && index < static_cast<int>(unit_.starts().size()) &&
                          std::abs(reading.linear_acceleration.z() - 9.81) < 1e-9 &&
                          std::abs(reading.angular_velocity.z() - 0.3) < 1e-9;
    wrong += is_right ? 0 : 1;
    if (!is_right) return;
    add_stamp_error(1e-3 * static_cast<double>(reading.utime -
                                               unit_.starts()[static_cast<std::size_t>(index)]));
  }

  ImuEmulator& unit_;
};

TEST(ImuVectorNavLive, PublishesReadingsThroughAllThatHappensToAnImu) {
  const test::ScratchFolder folder;
  ImuEmulator unit({.boot_s = 0.2}, LiveImu::reading);
  PtyLaser<ImuEmulator> line(folder / "imu", unit);
  LiveImu live(unit, line);
  live.start(ADIT_IMU_VECTORNAV, "",
             fmt::format("imu_vectornav: {{device: {}}}\n", (folder / "imu").string()));
  ASSERT_TRUE(live.has_health(Level::kFault));
  EXPECT_EQ(live.readings, 0);

  unit.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(1));
  ASSERT_TRUE(live.has_health(Level::kOk)) << live.health->reason;
  ASSERT_TRUE(live.more_readings_arrive(100));
  EXPECT_LT(live.core_share(500), kBusyLoopShare);
  EXPECT_LT(std::abs(live.stamp_error_ms()), kStampErrorMaxMs);
  EXPECT_EQ(live.check_driver(ADIT, "IMU"), 0);

  line.corrupt_share = 0.002;  // a fifth of the lines
  ASSERT_TRUE(live.more_readings_arrive(100));
  line.corrupt_share = 0.0;

  unit.power_off();
  ASSERT_TRUE(live.has_health(Level::kFault));
  unit.power_on(wall_utime());
  ASSERT_TRUE(live.more_readings_arrive(100));

  line.line().unplug();
  ASSERT_TRUE(live.has_health(Level::kFault, "imu"));
  line.line().plug();
  ASSERT_TRUE(live.more_readings_arrive(100));
  EXPECT_TRUE(live.has_health(Level::kDegraded, "gaps since the start")) << live.health->reason;
  EXPECT_EQ(live.wrong, 0);
  EXPECT_EQ(live.driver().terminate(), 0);
}

}  // namespace
}  // namespace adit
