// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tilt/servo.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

// Control table of the X series, address and length (e-manual, XL430-W250 and XM430-W350).
struct Registers {
  std::uint16_t address = 0;
  std::uint16_t length = 0;
};
constexpr Registers kOperatingMode{11, 1};
constexpr Registers kTorqueEnable{64, 1};
constexpr Registers kStateRegisters{64, 7};          // torque enable to hardware error status
constexpr std::uint16_t kProfileAcceleration = 108;  // then profile velocity, goal position
constexpr Registers kPresent{120, 16};               // realtime tick to present position

constexpr std::size_t kStatusReturnLevelAt = 68 - 64;
constexpr std::size_t kHardwareErrorAt = 70 - 64;
constexpr std::size_t kVelocityAt = 128 - 120;
constexpr std::size_t kPositionAt = 132 - 120;

constexpr std::uint8_t kPositionControl = 3;  // also 4, of several turns, and 5, with a current
constexpr std::uint8_t kCurrentBasedPosition = 5;
constexpr std::uint8_t kAnswersAll = 2;

constexpr double kTicksPerTurn = 4096.0;
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kVelocityUnitRad_S = 0.229 * kTurn / 60.0;
constexpr double kAccelerationUnitRad_S2 = 214.577 * kTurn / 3600.0;
constexpr std::int64_t kTickTurnMs = 32768;

constexpr int kUnansweredMax = 10;
constexpr int kUnansweredMaxSearching = 3;
constexpr std::int64_t kAnswerTimeoutUs = 30'000;
constexpr std::int64_t kStatePeriodUs = 1'000'000;

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value |= static_cast<std::uint32_t>(bytes[at + i]) << 8 * i;
  }
  return value;
}

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i & 0xFFU));
  }
}

std::string text_of_hardware_error(std::uint8_t error) {
  static constexpr std::pair<int, const char*> kBits[] = {{0, "input voltage"},
                                                          {2, "overheating"},
                                                          {3, "motor encoder"},
                                                          {4, "electrical shock"},
                                                          {5, "overload"}};
  std::string text;
  for (const auto& [bit, name] : kBits) {
    if ((error >> bit & 1) != 0) text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text.empty() ? fmt::format("status {}", error) : text;
}

}  // namespace

TiltServo::TiltServo(const TiltServoParams& params)
    : params_(params), bauds_(params.baud, {57600, 1'000'000, 115200, 9600, 2'000'000}) {
  if (params.angle_min_rad >= params.angle_max_rad) {
    throw std::invalid_argument(fmt::format("angle_min_rad is {}, not less than angle_max_rad, {}",
                                            params.angle_min_rad, params.angle_max_rad));
  }
}

double TiltServo::angle_rad(std::int32_t position) const {
  const double ticks = static_cast<double>(position) - params_.level_position;
  return sign() * ticks * kTurn / kTicksPerTurn;
}

std::int32_t TiltServo::position(double angle_rad) const {
  return params_.level_position +
         static_cast<std::int32_t>(std::lround(sign() * angle_rad * kTicksPerTurn / kTurn));
}

void TiltServo::command(const TiltCommand& command) {
  command_ = {command.utime,
              std::clamp(command.angle_rad, params_.angle_min_rad, params_.angle_max_rad),
              std::min(command.rate_rad_s, params_.rate_max_rad_s)};
  command_is_new_ = true;
}

std::vector<PortRequest> TiltServo::take_requests() { return std::exchange(requests_, {}); }

void TiltServo::start(std::int64_t now_us) {
  bauds_.found();
  problem_.clear();
  search(now_us, {});
}

void TiltServo::search(std::int64_t now_us, const std::string& why) {
  if (!why.empty()) problem_ = why;
  decoder_.clear();
  requests_.push_back({bauds_.current(), {}});
  held_.reset();
  enter(Step::kFind, now_us);
}

void TiltServo::enter(Step step, std::int64_t now_us) {
  step_ = step;
  unanswered_ = 0;
  question_ = Question::kNone;
  if (step != Step::kStream) ask_next(now_us);
}

std::size_t TiltServo::answer_bytes(Question question) {
  switch (question) {
    case Question::kPing:
      return 3;  // model, firmware
    case Question::kMode:
      return kOperatingMode.length;
    case Question::kState:
      return kStateRegisters.length;
    case Question::kPosition:
      return kPresent.length;
    default:
      return 0;
  }
}

/// Profile acceleration, profile velocity and goal position.
std::vector<std::uint8_t> TiltServo::goal_registers() const {
  const double rate = command_ ? command_->rate_rad_s : params_.rate_max_rad_s;
  const std::int32_t goal = command_ ? position(command_->angle_rad) : held_.value_or(0);
  const auto units = [](double value, double unit) {  // 0 is without limit
    return static_cast<std::uint32_t>(std::max(1L, std::lround(value / unit)));
  };
  std::vector<std::uint8_t> bytes;
  append(bytes, units(params_.acceleration_rad_s2, kAccelerationUnitRad_S2), 4);
  append(bytes, units(rate, kVelocityUnitRad_S), 4);
  append(bytes, static_cast<std::uint32_t>(goal), 4);
  return bytes;
}

void TiltServo::ask(Question question, std::int64_t now_us) {
  std::vector<std::uint8_t> parameters;
  DynamixelInstruction instruction = DynamixelInstruction::kRead;
  const auto read = [&parameters](const Registers& registers) {
    append(parameters, registers.address, 2);
    append(parameters, registers.length, 2);
  };
  switch (question) {
    case Question::kPing:
      instruction = DynamixelInstruction::kPing;
      break;
    case Question::kMode:
      read(kOperatingMode);
      break;
    case Question::kState:
      read(kStateRegisters);
      state_us_ = now_us;
      break;
    case Question::kPosition:
      read(kPresent);
      break;
    case Question::kGoal: {
      instruction = DynamixelInstruction::kWrite;
      append(parameters, kProfileAcceleration, 2);
      const auto registers = goal_registers();
      parameters.insert(parameters.end(), registers.begin(), registers.end());
      command_is_new_ = false;
      break;
    }
    case Question::kTorque:
      instruction = DynamixelInstruction::kWrite;
      append(parameters, kTorqueEnable.address, 2);
      parameters.push_back(1);
      break;
    case Question::kNone:
      return;
  }
  const auto packet =
      encode_instruction(static_cast<std::uint8_t>(params_.id), instruction, parameters);
  asked_us_ = now_us + std::llround(static_cast<double>(packet.size()) * byte_us());
  question_ = question;
  requests_.push_back({std::nullopt, packet});
}

void TiltServo::ask_next(std::int64_t now_us) {
  switch (step_) {
    case Step::kFind:
      return ask(Question::kPing, now_us);
    case Step::kMode:
      return ask(Question::kMode, now_us);
    case Step::kState:
      return ask(Question::kState, now_us);
    case Step::kPosition:
      return ask(Question::kPosition, now_us);
    case Step::kGoal:
      return ask(Question::kGoal, now_us);
    case Step::kTorque:
      return ask(Question::kTorque, now_us);
    case Step::kStream:
      if (command_is_new_) return ask(Question::kGoal, now_us);
      if (now_us - state_us_ >= kStatePeriodUs) return ask(Question::kState, now_us);
      return ask(Question::kPosition, now_us);
  }
}

void TiltServo::tick(std::int64_t now_us) {
  if (question_ != Question::kNone) {
    if (now_us - asked_us_ < kAnswerTimeoutUs) return;
    if (question_ == Question::kGoal) command_is_new_ = command_.has_value();
    ++unanswered_;
  }
  if (step_ == Step::kFind && unanswered_ >= kUnansweredMaxSearching) {
    const bool all_tried = bauds_.advance();
    return search(now_us, all_tried ? "no answer at any baud rate" : "");
  }
  if (unanswered_ >= kUnansweredMax) return search(now_us, "it stopped answering");
  ask_next(now_us);
}

std::vector<TiltReading> TiltServo::receive(std::span<const std::uint8_t> bytes,
                                            std::int64_t now_us) {
  std::vector<TiltReading> readings;
  decoder_.add(bytes, now_us, byte_us());
  while (const auto status = decoder_.next()) {
    if (status->id != params_.id || question_ == Question::kNone) continue;
    if (const auto reading = process(*status, now_us)) readings.push_back(*reading);
  }
  return readings;
}

std::optional<TiltReading> TiltServo::process(const DynamixelStatus& status, std::int64_t now_us) {
  const bool is_rejected = status.error_number() != 0;
  // The answer to an earlier question, which was late?
  if (!is_rejected && status.parameters.size() != answer_bytes(question_)) return std::nullopt;
  const Question question = std::exchange(question_, Question::kNone);
  unanswered_ = 0;
  bauds_.found();
  if (status.alert() && hardware_error_ == 0) state_us_ = 0;  // ask for it at once
  std::string& rejection = question == Question::kGoal ? goal_rejection_ : rejection_;
  rejection.clear();
  if (is_rejected) {
    rejection =
        fmt::format("the servo rejects {} with error {}",
                    question == Question::kGoal ? "the goal" : "a request", status.error_number());
    return std::nullopt;  // until the next tick
  }
  switch (question) {
    case Question::kPing:
      problem_.clear();
      enter(Step::kMode, now_us);
      break;
    case Question::kMode:
      if (status.parameters[0] >= kPositionControl &&
          status.parameters[0] <= kCurrentBasedPosition) {
        enter(Step::kState, now_us);
      } else {
        rejection_ =
            fmt::format("its operating mode is {}: set it to 3, position control, with its tool",
                        status.parameters[0]);
      }
      break;
    case Question::kState:
      process_state(status, now_us);
      break;
    case Question::kPosition:
      return process_position(status, now_us);
    case Question::kGoal:
      if (step_ == Step::kStream) {
        ask_next(now_us);
      } else {
        enter(torque_ ? Step::kStream : Step::kTorque, now_us);
      }
      break;
    case Question::kTorque:
      command_is_new_ = command_.has_value();  // switching on may have replaced the goal
      torque_ = true;
      enter(Step::kStream, now_us);
      break;
    case Question::kNone:
      break;
  }
  return std::nullopt;
}

void TiltServo::process_state(const DynamixelStatus& status, std::int64_t now_us) {
  torque_ = status.parameters[0] != 0;
  hardware_error_ = status.parameters[kHardwareErrorAt];
  if (status.parameters[kStatusReturnLevelAt] != kAnswersAll) {
    rejection_ = fmt::format("its status return level is {}: set it to 2 with its tool",
                             status.parameters[kStatusReturnLevelAt]);
    step_ = Step::kState;
  } else if (hardware_error_ != 0) {
    step_ = Step::kStream;  // where it is remains known
    ask(Question::kPosition, now_us);
  } else if (step_ == Step::kStream && torque_) {
    ask_next(now_us);
  } else {  // at the start, or switched off and on in the meantime
    held_.reset();
    enter(Step::kPosition, now_us);
  }
}

/// The clock of the servo has 15 bits of milliseconds. One that does not follow the arrivals was
/// switched off, or is damaged; the torque tells.
bool TiltServo::accept_tick(std::uint16_t tick_ms, std::int64_t arrival_us) {
  constexpr std::int64_t kOffMaxMs = 200;
  if (!tick_ms_) {
    tick_ms_ = tick_ms;
    device_us_ = 1000 * static_cast<std::int64_t>(tick_ms);
    arrival_us_ = arrival_us;
    return true;
  }
  const std::int64_t arrivals_ms = (arrival_us - arrival_us_) / 1000;
  const std::int64_t off_ms =
      ((tick_ms - *tick_ms_ - arrivals_ms) % kTickTurnMs + kTickTurnMs + kTickTurnMs / 2) %
          kTickTurnMs -
      kTickTurnMs / 2;
  const std::int64_t since_ms = arrivals_ms + off_ms;
  if (since_ms <= 0 || std::abs(off_ms) > kOffMaxMs) {
    tick_ms_.reset();
    clock_.reset();
    state_us_ = 0;  // ask at once
    return false;
  }
  tick_ms_ = tick_ms;
  device_us_ += 1000 * since_ms;
  arrival_us_ = arrival_us;
  return true;
}

std::optional<TiltReading> TiltServo::process_position(const DynamixelStatus& status,
                                                       std::int64_t now_us) {
  constexpr std::int64_t kHalfTickUs = 500;  // the mean of what a stamp leaves out
  const std::span<const std::uint8_t> registers(status.parameters);
  const auto position = static_cast<std::int32_t>(number_at(registers, kPositionAt, 4));
  const auto velocity = static_cast<std::int32_t>(number_at(registers, kVelocityAt, 4));
  const auto tick_ms = static_cast<std::uint16_t>(number_at(registers, 0, 2));
  if (step_ == Step::kPosition) {
    held_ = position;
    enter(Step::kGoal, now_us);
    return std::nullopt;
  }
  if (step_ != Step::kStream || !accept_tick(tick_ms, status.end_us)) return std::nullopt;
  const std::int64_t at_us = device_us_ + kHalfTickUs;
  clock_.add_answer(at_us, asked_us_, std::max(asked_us_, status.start_us));
  clock_.add_arrival(at_us, status.end_us);
  return TiltReading{clock_.utime(at_us, 0.0) - std::llround(1000.0 * params_.delay_ms),
                     angle_rad(position), sign() * velocity * kVelocityUnitRad_S};
}

DeviceProtocol::LineCounts TiltServo::line_counts() const {
  return {decoder_.counts().packets, decoder_.counts().corrupt};
}

std::string TiltServo::problem() const {
  if (!rejection_.empty()) return rejection_;
  if (!goal_rejection_.empty()) return goal_rejection_;
  if (step_ == Step::kFind) {
    return fmt::format("{}{}searching servo {} at {} baud", problem_, problem_.empty() ? "" : ": ",
                       params_.id, bauds_.current());
  }
  if (hardware_error_ != 0) {
    return fmt::format("hardware error, {}: mend it, then switch the servo off and on",
                       text_of_hardware_error(hardware_error_));
  }
  if (step_ != Step::kStream) return fmt::format("setting servo {}", params_.id);
  return {};
}

}  // namespace adit
