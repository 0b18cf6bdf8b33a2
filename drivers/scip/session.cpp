// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scip/session.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr int kAttempts = 3;
constexpr int kTimes = 10;  // that the laser is asked for its time
constexpr std::int64_t kAnswerTimeoutUs = 500'000;
constexpr std::int64_t kScanTimeoutUs = 500'000;

bool is_done(const ScipResponse& response) { return response.status == "00"; }

}  // namespace

ScipSession::ScipSession(const ScipParams& params)
    : params_(params), has_baud_(params.device.starts_with('/')) {}

std::vector<PortRequest> ScipSession::take_requests() { return std::exchange(requests_, {}); }

std::vector<ScipSession::TimeAnswer> ScipSession::take_time_answers() {
  return std::exchange(times_, {});
}

void ScipSession::request_baud(int baud) {
  baud_ = baud;
  decoder_.clear();
  requests_.push_back({baud, {}});
}

void ScipSession::start(std::int64_t now_us) {
  baud_ = 0;
  search(now_us, {});
}

void ScipSession::search(std::int64_t now_us, std::string_view why) {
  if (!why.empty()) problem_ = why;
  bauds_.clear();
  for (const int baud : {baud_, params_.baud, 19200, 115200, 57600, 38400, 500000}) {
    if (baud != 0 && std::ranges::find(bauds_, baud) == bauds_.end()) bauds_.push_back(baud);
  }
  if (!has_baud_) bauds_.resize(1);
  request_baud(bauds_.front());
  enter(Step::kFind, now_us);
}

void ScipSession::enter(Step step, std::int64_t now_us) {
  step_ = step;
  attempts_ = 0;
  rejection_.clear();
  send_request(now_us);
}

std::string ScipSession::command() const {
  switch (step_) {
    case Step::kFind:
    case Step::kVerifyBaud:
      return "QT";
    case Step::kBaud:
      return fmt::format("SS{:06}", params_.baud);
    case Step::kParameters:
      return "PP";
    case Step::kTimeOn:
      return "TM0";
    case Step::kTime:
      return "TM1";
    case Step::kTimeOff:
      return "TM2";
    case Step::kLaserOn:
      return "BM";
    case Step::kStart:  // no steps joined, every scan, without end
      return fmt::format("{}{:04}{:04}01000", params_.characters == 2 ? "MS" : "MD", first_step_,
                         last_step_);
    case Step::kStream:
      return {};
  }
  return {};
}

void ScipSession::send_request(std::int64_t now_us) {
  ++attempts_;
  asked_us_ = now_us;
  if (step_ == Step::kStream) {
    deadline_us_ = now_us + scan_timeout_us();
    return;
  }
  deadline_us_ = now_us + kAnswerTimeoutUs;
  // What was sent at a wrong baud rate before is a line of its own.
  const std::string text = fmt::format("{}{}\n", step_ == Step::kFind ? "\n" : "", command());
  requests_.push_back({std::nullopt, {text.begin(), text.end()}});
}

std::int64_t ScipSession::scan_timeout_us() const {
  const double line_us = byte_us() * 3.3 * beams();
  return std::max(kScanTimeoutUs,
                  static_cast<std::int64_t>(5.0 * (line_us + laser_->scan_period_us())));
}

void ScipSession::tick(std::int64_t now_us) {
  if (now_us >= deadline_us_) repeat_or_search(now_us);
}

void ScipSession::repeat_or_search(std::int64_t now_us) {
  if (step_ == Step::kStream) {
    search(now_us, "it stopped sending");
  } else if (step_ == Step::kFind) {
    bauds_.pop_front();
    if (bauds_.empty()) {
      search(now_us, has_baud_ ? "no answer at any baud rate" : "no answer");
    } else {
      request_baud(bauds_.front());
      enter(Step::kFind, now_us);
    }
  } else if (step_ == Step::kTimeOn || step_ == Step::kTime || step_ == Step::kTimeOff) {
    enter(Step::kLaserOn, now_us);  // not every laser tells its time
  } else if (attempts_ < kAttempts) {
    send_request(now_us);
  } else {
    search(now_us,
           rejection_.empty() ? fmt::format("no answer while {}", step_text()) : rejection_);
  }
}

std::vector<ScipSession::Scan> ScipSession::receive(std::span<const std::uint8_t> bytes,
                                                    std::int64_t now_us) {
  std::vector<Scan> scans;
  decoder_.add(bytes, now_us, byte_us());
  while (const auto response = decoder_.next()) {
    if (step_ != Step::kStream) {
      process_answer(*response, response->end_us);
    } else if (auto scan = scan_of(*response)) {
      scans.push_back(std::move(*scan));
      problem_.clear();
      deadline_us_ = now_us + scan_timeout_us();
    }
  }
  return scans;
}

std::optional<ScipSession::Scan> ScipSession::scan_of(const ScipResponse& response) const {
  constexpr const char* kIsScan = "99";
  if (response.status != kIsScan || !(response.is_of("MD") || response.is_of("MS"))) {
    return std::nullopt;
  }
  const auto readings = read_readings(response, static_cast<std::size_t>(params_.characters));
  if (!readings || static_cast<int>(readings->raw_mm.size()) != beams()) return std::nullopt;
  return Scan{*readings, first_step_, response.end_us, response.bytes};
}

void ScipSession::process_answer(const ScipResponse& response, std::int64_t now_us) {
  if (response.echo != command()) return;
  switch (step_) {
    case Step::kFind:
      enter(has_baud_ && baud_ != params_.baud ? Step::kBaud : Step::kParameters, now_us);
      break;
    case Step::kBaud:
      // By USB the laser rejects it, and the rate does not matter.
      if (is_done(response)) request_baud(params_.baud);
      enter(Step::kVerifyBaud, now_us);
      break;
    case Step::kVerifyBaud:
      enter(Step::kParameters, now_us);
      break;
    case Step::kParameters:
      process_parameters(response, now_us);
      break;
    case Step::kTimeOn:
      times_asked_ = 0;
      enter(is_done(response) ? Step::kTime : Step::kLaserOn, now_us);
      break;
    case Step::kTime:
      process_time(response, now_us);
      break;
    case Step::kTimeOff:
      enter(Step::kLaserOn, now_us);
      break;
    case Step::kLaserOn:
      if (is_done(response) || response.status == "02") {  // it was on
        enter(Step::kStart, now_us);
      } else {
        rejection_ =
            fmt::format("the laser cannot be switched on, status {}", quote(response.status));
      }
      break;
    case Step::kStart:
      if (is_done(response)) {
        enter(Step::kStream, now_us);
      } else {
        rejection_ = fmt::format("the laser does not start, status {}", quote(response.status));
      }
      break;
    case Step::kStream:
      break;
  }
}

void ScipSession::process_parameters(const ScipResponse& response, std::int64_t now_us) {
  const auto laser = read_parameters(response);
  if (!laser) {
    rejection_ = laser.rejection();
    return;
  }
  laser_ = *laser;
  const double step_deg = laser_->step_rad() * 180.0 / std::numbers::pi;
  const auto step_at = [&](double angle_deg) {
    return laser_->front_step + static_cast<int>(std::lround(angle_deg / step_deg));
  };
  first_step_ = std::max(laser_->first_step, step_at(params_.angle_min_deg));
  last_step_ = std::min(laser_->last_step, step_at(params_.angle_max_deg));
  if (first_step_ < last_step_) {
    enter(Step::kTimeOn, now_us);
  } else {
    rejection_ = "the laser measures none of the angles from angle_min_deg to angle_max_deg";
  }
}

void ScipSession::process_time(const ScipResponse& response, std::int64_t now_us) {
  if (const auto time_ms = read_time(response)) {
    times_.push_back({*time_ms, asked_us_, response.end_us});
  }
  enter(++times_asked_ < kTimes ? Step::kTime : Step::kTimeOff, now_us);
}

std::string ScipSession::step_text() const {
  switch (step_) {
    case Step::kFind:
      return has_baud_ ? fmt::format("searching the laser at {} baud", baud_)
                       : "searching the laser";
    case Step::kBaud:
    case Step::kVerifyBaud:
      return fmt::format("changing to {} baud", params_.baud);
    case Step::kParameters:
      return "reading the parameters";
    case Step::kTimeOn:
    case Step::kTime:
    case Step::kTimeOff:
      return "asking for the time";
    case Step::kLaserOn:
      return "switching the laser on";
    case Step::kStart:
      return "starting the output";
    case Step::kStream:
      return "measuring";
  }
  return {};
}

std::string ScipSession::status_text() const {
  return problem_.empty() ? step_text() : fmt::format("{}: {}", problem_, step_text());
}

}  // namespace adit
