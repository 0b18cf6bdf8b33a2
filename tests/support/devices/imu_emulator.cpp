// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/devices/imu_emulator.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::int64_t kAnswerUs = 1500;
constexpr std::size_t kStartsMax = 2000;

std::uint8_t checksum(const std::string& text) {
  unsigned char sum = 0;
  for (const char c : text) sum ^= static_cast<unsigned char>(c);
  return sum;
}

/// calculateCRC of the manual.
std::uint16_t crc16(const std::string& text) {
  std::uint16_t crc = 0;
  for (const char c : text) {
    crc = static_cast<std::uint16_t>(crc >> 8 | crc << 8);
    crc ^= static_cast<unsigned char>(c);
    crc ^= static_cast<std::uint16_t>((crc & 0xFF) >> 4);
    crc ^= static_cast<std::uint16_t>(crc << 12);
    crc ^= static_cast<std::uint16_t>((crc & 0xFF) << 5);
  }
  return crc;
}

}  // namespace

void ImuEmulator::power_on(std::int64_t utime) {
  is_on_ = true;
  booted_us_ = utime + std::llround(1e6 * params_.boot_s);
  baud_ = 115200;
  baud_after_ = 0;
  registers_ = {{6, 14}, {7, 40}, {30, 1}};
  next_us_ = static_cast<double>(booted_us_) + 321.0;
  input_.clear();
  line_.clear();
  line_free_us_ = utime;
}

void ImuEmulator::power_off() {
  is_on_ = false;
  line_.clear();
}

void ImuEmulator::already_streams(std::int64_t utime, int baud) {
  power_on(utime);
  booted_us_ = utime;
  next_us_ = static_cast<double>(utime);
  baud_ = baud;
}

void ImuEmulator::receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime) {
  if (!is_on_ || utime < booted_us_) return;
  for (const std::uint8_t byte : bytes) {
    input_ += static_cast<char>(host_baud == baud_ ? byte : random_());
  }
  for (auto end = input_.find('\n'); end != std::string::npos; end = input_.find('\n')) {
    const auto start = input_.rfind('$', end);
    if (start != std::string::npos) execute(input_.substr(start + 1, end - start - 1), utime);
    input_.erase(0, end + 1);
  }
  if (input_.size() > 500) input_.clear();
}

/// `text` ends with *, checksum and carriage return.
void ImuEmulator::execute(const std::string& text, std::int64_t utime) {
  const auto star = text.find('*');
  if (star == std::string::npos || text.back() != '\r') return;
  const std::string content = text.substr(0, star);
  const std::string digits = text.substr(star + 1, text.size() - star - 2);
  const auto expected = digits.size() == 4 ? fmt::format("{:04X}", crc16(content))
                                           : fmt::format("{:02X}", checksum(content));
  if (digits != expected) return send_line("VNERR,03", utime);
  std::vector<std::string> fields;
  std::istringstream parts(content);
  for (std::string field; std::getline(parts, field, ',');) fields.push_back(field);
  if (fields.size() == 2 && fields[0] == "VNRRG") {
    if (fields[1] == "01" || fields[1] == "1") return send_line("VNRRG,01,VN-100S-CR", utime);
    return send_line("VNERR,08", utime);
  }
  if (fields.empty() || fields[0] != "VNWRG") return send_line("VNERR,04", utime);
  if (fields.size() < 3) return send_line("VNERR,05", utime);
  const int address = std::stoi(fields[1]);
  const int value = std::stoi(fields[2]);
  if (address == 5) {
    const std::vector<int> bauds{9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600};
    if (std::ranges::find(bauds, value) == bauds.end()) return send_line("VNERR,07", utime);
    send_line(content, utime);
    baud_after_ = value;
  } else if (address == 30 && fields.size() == 9) {
    registers_[30] = std::stoi(fields[6]);
    send_line(content, utime);
  } else if (address == 7) {
    // Its output must fit the line.
    if (value * 1150 > baud_) return send_line("VNERR,12", utime);
    registers_[7] = value;
    send_line(content, utime);
  } else if (address == 6) {
    registers_[6] = value;
    send_line(content, utime);
  } else {
    send_line("VNERR,08", utime);
  }
}

void ImuEmulator::send_line(const std::string& text, std::int64_t utime) {
  const std::string line = registers_[30] == 3
                               ? fmt::format("${}*{:04X}\r\n", text, crc16(text))
                               : fmt::format("${}*{:02X}\r\n", text, checksum(text));
  const bool is_answer = !text.starts_with("VNIMU") && !text.starts_with("VNYMR");
  double at_us = static_cast<double>(std::max(utime + (is_answer ? kAnswerUs : 0), line_free_us_));
  for (const char c : line) {
    at_us += 1e7 / baud_;
    line_.push_back({std::llround(at_us), static_cast<std::uint8_t>(c)});
  }
  line_free_us_ = std::llround(at_us);
}

std::string ImuEmulator::output_line(int number) const {
  const auto r = reading_(number);
  const std::string magnetic = "+01.0670,-00.2568,+03.0696";
  const std::string motion =
      fmt::format("{:+07.3f},{:+07.3f},{:+07.3f},{:+010.6f},{:+010.6f},{:+010.6f}", r[0], r[1],
                  r[2], r[3], r[4], r[5]);
  if (registers_.at(6) == 19) return fmt::format("VNIMU,{},{},+22.5,+101.325", magnetic, motion);
  return fmt::format("VNYMR,-090.000,+000.100,-000.200,{},{}", magnetic, motion);
}

void ImuEmulator::measure(std::int64_t until) {
  while (next_us_ <= static_cast<double>(until)) {
    const auto at = std::llround(next_us_);
    next_us_ += 1e6 / registers_[7] / params_.clock_rate;
    const int number = next_number_++;
    starts_.push_back(at);
    if (starts_.size() > kStartsMax) starts_.pop_front();
    if (registers_[6] == 19 || registers_[6] == 14) send_line(output_line(number), at);
  }
}

std::vector<TimedByte> ImuEmulator::advance(std::int64_t utime, int host_baud) {
  if (!is_on_) return {};
  measure(utime);
  std::vector<TimedByte> sent = take_due(line_, utime);
  if (host_baud != baud_) garble(sent, random_);
  if (baud_after_ != 0 && line_.empty()) {
    baud_ = baud_after_;
    baud_after_ = 0;
  }
  return sent;
}

}  // namespace adit
