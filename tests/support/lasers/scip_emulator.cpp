// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lasers/scip_emulator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::int64_t kAnswerUs = 2000;

/// Six bits of each, the highest first, plus 30h.
std::string encoded(std::uint32_t number, int characters) {
  std::string text;
  for (int i = characters - 1; i >= 0; --i) {
    text += static_cast<char>((number / static_cast<std::uint32_t>(std::pow(64, i))) % 64 + 0x30);
  }
  return text;
}

char sum_of(const std::string& text) {
  int sum = 0;
  for (const char c : text) sum += c;
  return static_cast<char>(sum % 64 + 0x30);
}

/// With its checksum and line feed.
std::string line_of(const std::string& text) { return fmt::format("{}{}\n", text, sum_of(text)); }

/// The checksum of a parameter is behind a semicolon that it leaves out.
std::string parameter_of(const std::string& text) {
  return fmt::format("{};{}\n", text, sum_of(text));
}

std::string answer_of(const std::string& echo, const std::string& status) {
  return fmt::format("{}\n{}\n", echo, line_of(status));
}

}  // namespace

ScipEmulator::ScipEmulator(Params params, Reading reading)
    : params_(params), reading_(std::move(reading)) {}

double ScipEmulator::byte_us() const { return params_.has_baud ? 1e7 / baud_ : 1.0; }

void ScipEmulator::power_on(std::int64_t utime) {
  is_on_ = true;
  laser_is_on_ = false;
  is_adjusting_ = false;
  continuous_.clear();
  power_on_us_ = utime;
  booted_us_ = utime + std::llround(1e6 * params_.boot_s);
  baud_ = params_.baud_after_power_on;
  input_.clear();
  pending_.clear();
  line_.clear();
  line_free_us_ = utime;
  next_scan_ = 0;
}

void ScipEmulator::power_off() {
  is_on_ = false;
  pending_.clear();
  line_.clear();
}

void ScipEmulator::already_streams(std::int64_t utime, int baud) {
  power_on(utime);
  booted_us_ = utime;
  baud_ = baud;
  laser_is_on_ = true;
  from_ = params_.first_step;
  to_ = params_.last_step;
  continuous_ = "MD0000108001000";
}

std::string ScipEmulator::time_at(std::int64_t utime) const {
  const double ms = 1e-3 * static_cast<double>(utime - power_on_us_) * params_.clock_rate;
  return encoded((params_.clock_start_ms + static_cast<std::uint32_t>(ms)) % (1U << 24), 4);
}

void ScipEmulator::receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime) {
  if (!is_on_ || utime < booted_us_) return;
  const bool same_rate = !params_.has_baud || host_baud == baud_;
  for (const std::uint8_t byte : bytes) {
    input_ += static_cast<char>(same_rate ? byte : random_());
  }
  for (auto end = input_.find('\n'); end != std::string::npos; end = input_.find('\n')) {
    const std::string line = input_.substr(0, end);
    input_.erase(0, end + 1);
    if (!line.empty()) execute(line, utime);
  }
  if (input_.size() > 100) input_.clear();
}

std::string ScipEmulator::parameters() const {
  return parameter_of("MODL:UTM-30LX(Hokuyo Automatic Co.,Ltd.)") +
         parameter_of(fmt::format("DMIN:{}", params_.range_min_mm)) +
         parameter_of(fmt::format("DMAX:{}", params_.range_max_mm)) +
         parameter_of(fmt::format("ARES:{}", params_.steps_per_turn)) +
         parameter_of(fmt::format("AMIN:{}", params_.first_step)) +
         parameter_of(fmt::format("AMAX:{}", params_.last_step)) +
         parameter_of(fmt::format("AFRT:{}", params_.front_step)) +
         parameter_of(fmt::format("SCAN:{}", params_.scans_per_minute));
}

void ScipEmulator::execute(const std::string& line, std::int64_t utime) {
  const std::string command = line.substr(0, 2);
  const std::string echo = fmt::format("{}\n", line);
  if (command == "QT") {
    continuous_.clear();
    laser_is_on_ = false;
    send(answer_of(line, "00"), utime + kAnswerUs);
  } else if (command == "PP") {
    send(fmt::format("{}{}{}\n", echo, line_of("00"), parameters()), utime + kAnswerUs);
  } else if (command == "BM") {
    const bool was_on = std::exchange(laser_is_on_, true);
    send(answer_of(line, was_on ? "02" : "00"), utime + kAnswerUs);
  } else if (command == "TM" && params_.tells_time && line.size() > 2) {
    const char mode = line[2];
    if (mode == '0') is_adjusting_ = true;
    if (mode == '2') is_adjusting_ = false;
    if (mode == '1' && is_adjusting_) {
      send(fmt::format("{}{}{}\n", echo, line_of("00"), line_of(time_at(utime + kAnswerUs))),
           utime + kAnswerUs);
    } else {
      send(answer_of(line, mode == '1' ? "04" : "00"), utime + kAnswerUs);
    }
  } else if (command == "SS" && line.size() == 8 && params_.has_baud) {
    send(answer_of(line, "00"), utime + kAnswerUs, std::stoi(line.substr(2)));
  } else if (command == "MD" || command == "MS") {
    send(answer_of(line, execute_measurement(line)), utime + kAnswerUs);
  } else {
    send(answer_of(line, "0E"), utime + kAnswerUs);
  }
}

/// Returns the status.
std::string ScipEmulator::execute_measurement(const std::string& line) {
  if (line.size() != 15 || is_adjusting_) return "0C";
  if (!laser_is_on_) return "0B";
  from_ = std::stoi(line.substr(2, 4));
  to_ = std::stoi(line.substr(6, 4));
  if (from_ < params_.first_step || to_ > params_.last_step || from_ > to_) return "04";
  characters_ = line[1] == 'S' ? 2 : 3;
  continuous_ = line;
  starts_.clear();
  return "00";
}

void ScipEmulator::send(std::string text, std::int64_t start, int baud_after) {
  pending_.push_back({start, std::move(text), baud_after});
}

std::int64_t ScipEmulator::scan_start(int scan) const {
  return starts_.at(static_cast<std::size_t>(scan));
}

/// Scans end at fixed times. One is sent if the line is free then; otherwise it is lost.
void ScipEmulator::measure(std::int64_t until) {
  const double period_us = 60e6 / params_.scans_per_minute / params_.clock_rate;
  while (!continuous_.empty()) {
    const double start_us = static_cast<double>(power_on_us_ + kFirstScanUs) +
                            static_cast<double>(next_scan_) * period_us;
    const auto start =
        std::llround(start_us + period_us * (from_ - params_.first_step) / params_.steps_per_turn);
    const auto end =
        std::llround(start_us + period_us * (to_ - params_.first_step) / params_.steps_per_turn);
    if (end > until) return;
    ++next_scan_;
    if (end < booted_us_ || end < line_free_us_) continue;
    const int scan = scans_sent();
    starts_.push_back(start);
    std::string data;
    for (int step = from_; step <= to_; ++step) data += encoded(reading_(scan, step), characters_);
    std::string text = fmt::format("{}\n{}{}", continuous_, line_of("99"), line_of(time_at(start)));
    for (std::size_t i = 0; i < data.size(); i += 64) text += line_of(data.substr(i, 64));
    text += "\n";
    send(std::move(text), end);
    return;
  }
}

std::vector<TimedByte> ScipEmulator::advance(std::int64_t utime, int host_baud) {
  if (!is_on_) return {};
  while (true) {
    if (pending_.empty()) measure(utime);
    if (pending_.empty() || pending_.front().start > utime) break;
    const Pending next = std::move(pending_.front());
    pending_.pop_front();
    double at_us = static_cast<double>(std::max(next.start, line_free_us_));
    for (const char c : next.text) {
      at_us += byte_us();
      const bool same_rate = !params_.has_baud || host_baud == baud_;
      line_.push_back({std::llround(at_us), static_cast<std::uint8_t>(same_rate ? c : random_())});
    }
    line_free_us_ = std::llround(at_us);
    if (next.baud_after != 0) baud_ = next.baud_after;
  }
  return take_due(line_, utime);
}

}  // namespace adit
