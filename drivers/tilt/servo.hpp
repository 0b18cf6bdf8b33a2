// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/device/baud_search.hpp"
#include "drivers/device/device_protocol.hpp"
#include "drivers/tilt/packet.hpp"
#include "drivers/timing/device_clock.hpp"

#include "common/config/bounds.hpp"
#include "common/sensing/laser_tilt.hpp"

namespace adit {

/// The section of the tilt servo of one laser.
struct TiltServoParams {
  std::string device = "/dev/ttyUSB0";
  int baud = 57600;
  int id = 1;
  int level_position = 2048;  ///< at which the laser is level, of 4096 in a turn
  bool reversed = false;      ///< positions increase when the laser tilts upwards
  double angle_min_rad = -0.6;
  double angle_max_rad = 0.6;
  double rate_max_rad_s = 1.0;
  double acceleration_rad_s2 = 3.0;
  double delay_ms = 0.0;  ///< of a position behind its measurement, if it was measured

  template <class V>
  void visit(V& v) {
    v("device", device);
    v("baud", baud, within(9600, 3'000'000));
    v("id", id, within(0, 252));
    v("level_position", level_position, within(0, 4095));
    v("reversed", reversed);
    v("angle_min_rad", angle_min_rad, within(-1.5, 1.5));
    v("angle_max_rad", angle_max_rad, within(-1.5, 1.5));
    v("rate_max_rad_s", rate_max_rad_s, within(0.03, 10.0));
    v("acceleration_rad_s2", acceleration_rad_s2, within(0.4, 100.0));
    v("delay_ms", delay_ms, within(-100.0, 100.0));
  }
};

/// A servo of the X series of DYNAMIXEL (XL430, XM430 and others with the same control table)
/// without port or clock: bytes and commands in, tilts and requests out. Finds its baud rate, holds
/// it at the last command, otherwise where it is, and reads its position at each tick. A servo that
/// was switched off is set again. Never writes its EEPROM.
class TiltServo final : public ReadingDevice<TiltReading> {
 public:
  using Params = TiltServoParams;

  static constexpr std::int64_t kTickUs = 20'000;

  /// Throws std::invalid_argument, with the remedy, for parameters that contradict each other.
  explicit TiltServo(const TiltServoParams& params);

  /// Angle and rate are clamped to the limits of the configuration.
  void command(const TiltCommand& command);

  void start(std::int64_t now_us) override;
  std::vector<TiltReading> receive(std::span<const std::uint8_t> bytes,
                                   std::int64_t now_us) override;
  void tick(std::int64_t now_us) override;
  std::vector<PortRequest> take_requests() override;
  [[nodiscard]] bool is_streaming() const override { return step_ == Step::kStream; }
  [[nodiscard]] std::string problem() const override;
  [[nodiscard]] LineCounts line_counts() const override;

  [[nodiscard]] const DeviceClock& clock() const { return clock_; }

 private:
  /// In this order.
  enum class Step {
    kFind,      ///< a baud rate at which it answers
    kMode,      ///< whether it is in a mode that controls positions
    kState,     ///< torque, what it answers, hardware error
    kPosition,  ///< where it is, for the first goal
    kGoal,      ///< acceleration, rate and goal
    kTorque,
    kStream
  };
  /// What was asked and is not answered.
  enum class Question { kNone, kPing, kMode, kState, kPosition, kGoal, kTorque };

  void search(std::int64_t now_us, const std::string& why);
  void enter(Step step, std::int64_t now_us);
  void ask_next(std::int64_t now_us);
  void ask(Question question, std::int64_t now_us);
  static std::size_t answer_bytes(Question question);
  [[nodiscard]] std::vector<std::uint8_t> goal_registers() const;
  std::optional<TiltReading> process(const DynamixelStatus& status, std::int64_t now_us);
  void process_state(const DynamixelStatus& status, std::int64_t now_us);
  std::optional<TiltReading> process_position(const DynamixelStatus& status, std::int64_t now_us);
  bool accept_tick(std::uint16_t tick_ms, std::int64_t arrival_us);
  [[nodiscard]] double angle_rad(std::int32_t position) const;
  [[nodiscard]] std::int32_t position(double angle_rad) const;
  [[nodiscard]] double sign() const { return params_.reversed ? -1.0 : 1.0; }
  [[nodiscard]] double byte_us() const { return 1e7 / bauds_.current(); }

  TiltServoParams params_;
  BaudSearch bauds_;
  DynamixelDecoder decoder_;
  std::vector<PortRequest> requests_;
  Step step_ = Step::kFind;
  Question question_ = Question::kNone;
  std::int64_t asked_us_ = 0;  ///< when the last bit of the question leaves
  int unanswered_ = 0;         ///< questions, one after the other
  std::optional<TiltCommand> command_;
  bool command_is_new_ = false;       ///< not sent
  std::optional<std::int32_t> held_;  ///< position at which it is held without a command
  std::int64_t state_us_ = 0;         ///< when its state was asked last
  bool torque_ = false;
  std::uint8_t hardware_error_ = 0;
  std::string rejection_;       ///< of the last request by the servo
  std::string goal_rejection_;  ///< of the last goal
  std::string problem_;         ///< of the last attempt
  DeviceClock clock_;
  std::optional<std::uint16_t> tick_ms_;  ///< its clock at the last position
  std::int64_t device_us_ = 0;            ///< the same without overflow
  std::int64_t arrival_us_ = 0;           ///< of it
};

}  // namespace adit
