// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sick_lms2xx/session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

// Commands, and their responses.
constexpr std::uint8_t kMode = 0x20;
constexpr std::uint8_t kModeResponse = 0xA0;
constexpr std::uint8_t kVariant = 0x3B;
constexpr std::uint8_t kVariantResponse = 0xBB;
constexpr std::uint8_t kReadConfig = 0x74;
constexpr std::uint8_t kReadConfigResponse = 0xF4;
constexpr std::uint8_t kWriteConfig = 0x77;
constexpr std::uint8_t kWriteConfigResponse = 0xF7;
constexpr std::uint8_t kSwitchedOn = 0x90;
constexpr std::uint8_t kMeasuredValues = 0xB0;

// Operating modes.
constexpr std::uint8_t kInstallation = 0x00;
constexpr std::uint8_t kContinuous = 0x24;
constexpr std::uint8_t kOnRequest = 0x25;

// Places in the configuration.
constexpr std::size_t kMeasuringMode = 5;
constexpr std::size_t kUnit = 6;
constexpr std::uint8_t kDistances13BitsMax = 2;  // measuring modes 0 to 2

constexpr int kBaudAfterSwitchOn = 9600;  // unless another was stored for ever
constexpr int kAttempts = 3;
constexpr int kMisfitsMax = 20;
constexpr std::int64_t kWriteTimeoutUs = 15'000'000;  // the laser stores its configuration
constexpr std::int64_t kNackPauseUs = 50'000;

std::uint8_t baud_mode(int baud) {
  switch (baud) {
    case 500000:
      return 0x48;
    case 38400:
      return 0x40;
    case 19200:
      return 0x41;
    default:
      return 0x42;
  }
}

std::uint8_t low(int value) { return static_cast<std::uint8_t>(value & 0xFF); }
std::uint8_t high(int value) { return static_cast<std::uint8_t>(value >> 8 & 0xFF); }

bool is_success(const LmsTelegram& mode_response) {
  return mode_response.data.size() > 1 && mode_response.data[0] == 0;
}

}  // namespace

LmsSession::LmsSession(const LmsSettings& settings) : settings_(settings) {
  settings_.require_valid();
}

/// Time for what the laser is sending now, and for the answer.
std::int64_t LmsSession::answer_timeout_us() const {
  constexpr std::int64_t kThinkingUs = 200'000;
  return kThinkingUs + std::llround(2.0 * kLmsTelegramBytesMax * byte_us());
}

std::int64_t LmsSession::scan_timeout_us() const {
  constexpr std::int64_t kLeastUs = 500'000;
  const double scan_us = settings_.telegram_us() + settings_.scan_period_us();
  return std::max(kLeastUs, static_cast<std::int64_t>(5.0 * scan_us));
}

std::vector<PortRequest> LmsSession::take_requests() { return std::exchange(requests_, {}); }

void LmsSession::send(std::span<const std::uint8_t> content) {
  requests_.push_back({std::nullopt, encode_lms_telegram(content)});
}

void LmsSession::request_baud(int baud) {
  baud_ = baud;
  decoder_.clear();
  requests_.push_back({baud, {}});
}

void LmsSession::start(std::int64_t now_us) {
  baud_ = 0;
  search(now_us, {});
}

/// Tries the baud rates, beginning with the likely ones.
void LmsSession::search(std::int64_t now_us, std::string_view why) {
  if (is_streaming()) ++counts_.losses;
  if (!why.empty()) problem_ = why;
  bauds_.clear();
  for (const int baud : {baud_, settings_.baud, kBaudAfterSwitchOn, 38400, 19200, 500000}) {
    if (baud != 0 && std::ranges::find(bauds_, baud) == bauds_.end()) bauds_.push_back(baud);
  }
  request_baud(bauds_.front());
  enter(Step::kFind, now_us);
}

void LmsSession::enter(Step step, std::int64_t now_us) {
  step_ = step;
  attempts_ = 0;
  misfits_ = 0;
  sends_scans_ = false;
  rejection_.clear();
  send_request(now_us);
}

void LmsSession::send_request(std::int64_t now_us) {
  ++attempts_;
  deadline_us_ = now_us + answer_timeout_us();
  switch (step_) {
    case Step::kFind:
    case Step::kVerifyBaud:
      send(std::vector{kMode, kOnRequest});
      break;
    case Step::kBaud:
      send(std::vector{kMode, baud_mode(settings_.baud)});
      break;
    case Step::kReadConfig:
      send(std::vector{kReadConfig});
      break;
    case Step::kLogin: {
      std::vector<std::uint8_t> content{kMode, kInstallation};
      content.insert(content.end(), settings_.password.begin(), settings_.password.end());
      send(content);
      break;
    }
    case Step::kWriteConfig: {
      std::vector<std::uint8_t> content{kWriteConfig};
      content.insert(content.end(), config_.begin(), config_.end());
      send(content);
      deadline_us_ = now_us + kWriteTimeoutUs;
      break;
    }
    case Step::kVariant: {
      const int field_of_view = settings_.field_of_view_deg;
      const int step = static_cast<int>(std::lround(100.0 * settings_.angle_step_deg));
      send(std::vector{kVariant, low(field_of_view), high(field_of_view), low(step), high(step)});
      break;
    }
    case Step::kStart:
      send(std::vector{kMode, kContinuous});
      break;
    case Step::kStream:
      deadline_us_ = now_us + scan_timeout_us();
      break;
  }
}

void LmsSession::tick(std::int64_t now_us) {
  if (now_us < deadline_us_) return;
  repeat_or_search(now_us);
}

/// There is no answer, or no scan.
void LmsSession::repeat_or_search(std::int64_t now_us) {
  if (step_ == Step::kStream) {
    search(now_us, "it stopped sending");
  } else if (step_ == Step::kFind && !(sends_scans_ && attempts_ < kAttempts)) {
    bauds_.pop_front();
    if (bauds_.empty()) {
      search(now_us, "no answer at any baud rate");
    } else {
      request_baud(bauds_.front());
      enter(Step::kFind, now_us);
    }
  } else if (attempts_ < kAttempts) {
    send_request(now_us);
  } else if (!rejection_.empty()) {
    search(now_us, rejection_);
  } else {
    search(now_us, fmt::format("no answer at {} baud while {}", baud_, step_text()));
  }
}

std::vector<LmsSession::Scan> LmsSession::receive(std::span<const std::uint8_t> bytes,
                                                  std::int64_t now_us) {
  std::vector<Scan> scans;
  decoder_.add(bytes, now_us, byte_us());
  while (const auto telegram = decoder_.next()) process(*telegram, now_us, scans);
  if (decoder_.take_nack() && step_ != Step::kStream) {
    deadline_us_ = std::min(deadline_us_, now_us + kNackPauseUs);
  }
  return scans;
}

void LmsSession::process(const LmsTelegram& telegram, std::int64_t now_us,
                         std::vector<Scan>& scans) {
  if (telegram.command == kSwitchedOn) {
    search(now_us, "the laser was switched on");
  } else if (step_ != Step::kStream) {
    process_answer(telegram, now_us);
  } else if (telegram.command == kMeasuredValues) {
    if (auto scan = scan_of(telegram)) {
      scans.push_back(std::move(*scan));
      deadline_us_ = now_us + scan_timeout_us();
    } else if (++misfits_ > kMisfitsMax) {
      search(now_us, "its scans are not as set");
    }
  }
}

std::optional<LmsSession::Scan> LmsSession::scan_of(const LmsTelegram& telegram) {
  const auto values = read_measured_values(telegram.data);
  if (!values || static_cast<int>(values->raw.size()) != settings_.beams() ||
      values->unit_m != settings_.unit_m()) {
    ++counts_.rejected;
    return std::nullopt;
  }
  misfits_ = 0;
  problem_.clear();
  ++counts_.scans;
  return Scan{*values, telegram.status(), telegram.end_us};
}

void LmsSession::process_answer(const LmsTelegram& telegram, std::int64_t now_us) {
  const bool mode_changed = telegram.command == kModeResponse && is_success(telegram);
  switch (step_) {
    case Step::kFind:
      if (mode_changed) {
        enter(baud_ == settings_.baud ? Step::kReadConfig : Step::kBaud, now_us);
      } else if (telegram.command == kMeasuredValues) {
        sends_scans_ = true;
      }
      break;
    case Step::kBaud:
      if (!mode_changed) break;
      request_baud(settings_.baud);
      enter(Step::kVerifyBaud, now_us);
      break;
    case Step::kVerifyBaud:
      if (mode_changed) enter(Step::kReadConfig, now_us);
      break;
    case Step::kReadConfig:
      if (telegram.command == kReadConfigResponse) process_config(telegram, now_us);
      break;
    case Step::kLogin:
      if (mode_changed) {
        enter(Step::kWriteConfig, now_us);
      } else if (telegram.command == kModeResponse) {
        rejection_ = "the laser rejects the password";
      }
      break;
    case Step::kWriteConfig:
      if (telegram.command != kWriteConfigResponse || telegram.data.empty()) break;
      if (telegram.data[0] == 1) {
        enter(Step::kVariant, now_us);
      } else {
        rejection_ = "the laser rejects the configuration";
      }
      break;
    case Step::kVariant:
      if (telegram.command != kVariantResponse || telegram.data.empty()) break;
      if (telegram.data[0] == 1) {
        enter(Step::kStart, now_us);
      } else {
        rejection_ = fmt::format("the laser rejects {}° in steps of {}°",
                                 settings_.field_of_view_deg, settings_.angle_step_deg);
      }
      break;
    case Step::kStart:
      if (mode_changed) enter(Step::kStream, now_us);
      break;
    case Step::kStream:
      break;
  }
}

/// Writing wears the memory of the laser, so that it is done only if something differs.
void LmsSession::process_config(const LmsTelegram& telegram, std::int64_t now_us) {
  if (telegram.data.size() < kUnit + 2) return;
  config_.assign(telegram.data.begin(), telegram.data.end() - 1);  // without the status
  const auto unit = static_cast<std::uint8_t>(settings_.unit == "mm" ? 1 : 0);
  const bool is_right = config_[kMeasuringMode] <= kDistances13BitsMax && config_[kUnit] == unit;
  if (config_[kMeasuringMode] > kDistances13BitsMax) config_[kMeasuringMode] = 0;
  config_[kUnit] = unit;
  enter(is_right ? Step::kVariant : Step::kLogin, now_us);
}

std::string LmsSession::step_text() const {
  switch (step_) {
    case Step::kFind:
      return fmt::format("searching the laser at {} baud", baud_);
    case Step::kBaud:
    case Step::kVerifyBaud:
      return fmt::format("changing to {} baud", settings_.baud);
    case Step::kReadConfig:
      return "reading the configuration";
    case Step::kLogin:
      return "logging in";
    case Step::kWriteConfig:
      return "writing the configuration";
    case Step::kVariant:
      return "setting the field of view";
    case Step::kStart:
      return "starting the output";
    case Step::kStream:
      return "measuring";
  }
  return {};
}

std::string LmsSession::status_text() const {
  return problem_.empty() ? step_text() : fmt::format("{}: {}", problem_, step_text());
}

}  // namespace adit
