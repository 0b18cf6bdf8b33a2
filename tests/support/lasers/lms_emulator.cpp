// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lasers/lms_emulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace adit {
namespace {

constexpr std::int64_t kAnswerUs = 10'000;
constexpr std::size_t kConfigurationBytes = 34;
constexpr int kUnitAt = 6;

/// As in the listing: the checksum register is shifted by one bit for each byte, and takes the
/// polynomial 8005h when its highest bit leaves it.
unsigned crc_of(const std::vector<std::uint8_t>& bytes) {
  unsigned crc = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const unsigned pair = bytes[i] + (i > 0 ? 256U * bytes[i - 1] : 0U);
    const bool carry = crc > 0x7FFF;
    crc = crc * 2 % 0x10000;
    if (carry) crc ^= 0x8005;
    crc ^= pair;
  }
  return crc;
}

void append_word(std::vector<std::uint8_t>& bytes, unsigned value) {
  bytes.push_back(static_cast<std::uint8_t>(value % 256));
  bytes.push_back(static_cast<std::uint8_t>(value / 256));
}

}  // namespace

LmsEmulator::LmsEmulator(Params params, Reading reading)
    : params_(std::move(params)),
      reading_(std::move(reading)),
      configuration_(kConfigurationBytes, 0) {}

void LmsEmulator::power_on(std::int64_t utime) {
  is_on_ = true;
  announced_ = false;
  booted_ = utime + std::llround(1e6 * params_.boot_s);
  mode_ = Mode::kOnRequest;
  baud_ = params_.baud_after_power_on;
  mirror_zero_ = utime + kFirstScanUs;  // any phase
  next_scan_ = 0;
  line_free_ = utime;
  input_.clear();
  pending_.clear();
  line_.clear();
}

void LmsEmulator::power_off() {
  is_on_ = false;
  pending_.clear();
  line_.clear();
}

void LmsEmulator::already_streams(std::int64_t utime, int baud) {
  power_on(utime);
  booted_ = utime;
  announced_ = true;
  baud_ = baud;
  mode_ = Mode::kContinuous;
}

std::vector<std::uint8_t> LmsEmulator::frame(const std::vector<std::uint8_t>& content) const {
  std::vector<std::uint8_t> bytes{0x02, 0x80};
  append_word(bytes, static_cast<unsigned>(content.size() + 1));
  bytes.insert(bytes.end(), content.begin(), content.end());
  bytes.push_back(params_.status);
  append_word(bytes, crc_of(bytes));
  return bytes;
}

void LmsEmulator::receive(std::span<const std::uint8_t> bytes, int host_baud, std::int64_t utime) {
  if (!is_on_ || utime < booted_) return;
  for (const std::uint8_t byte : bytes) {
    input_.push_back(host_baud == baud_ ? byte : static_cast<std::uint8_t>(random_()));
  }
  parse(utime);
}

void LmsEmulator::parse(std::int64_t utime) {
  while (true) {
    const auto start = std::find(input_.begin(), input_.end(), 0x02);
    input_.erase(input_.begin(), start);
    if (input_.size() < 4) return;
    const std::size_t size = input_[2] + 256U * input_[3];
    if (size > 100 || input_[1] != 0) {  // no host sends more
      input_.erase(input_.begin());
      continue;
    }
    if (input_.size() < size + 6) return;
    const std::vector<std::uint8_t> checked(input_.begin(),
                                            input_.begin() + static_cast<std::ptrdiff_t>(size) + 4);
    if (crc_of(checked) != input_[size + 4] + 256U * input_[size + 5]) {
      input_.erase(input_.begin());
      continue;
    }
    input_.erase(input_.begin(), input_.begin() + static_cast<std::ptrdiff_t>(size) + 6);
    execute(std::span(checked).subspan(4), utime);
  }
}

void LmsEmulator::execute(std::span<const std::uint8_t> content, std::int64_t utime) {
  const std::uint8_t command = content.empty() ? 0 : content[0];
  if (command == 0x20 && content.size() > 1) {
    execute_mode(content, utime);
  } else if (command == 0x3B && content.size() == 5 && mode_ != Mode::kContinuous) {
    const int field_of_view = content[1] + 256 * content[2];
    const int step = content[3] + 256 * content[4];
    const bool known = (field_of_view == 180 && (step == 100 || step == 50)) ||
                       (field_of_view == 100 && (step == 100 || step == 50 || step == 25));
    if (known) {
      field_of_view_deg_ = field_of_view;
      step_hundredths_ = step;
      starts_.clear();
    }
    answer({0xBB, static_cast<std::uint8_t>(known), content[1], content[2], content[3], content[4]},
           utime);
  } else if (command == 0x74) {
    std::vector<std::uint8_t> bytes{0xF4};
    bytes.insert(bytes.end(), configuration_.begin(), configuration_.end());
    answer(std::move(bytes), utime);
  } else if (command == 0x77 && content.size() == kConfigurationBytes + 1) {
    const bool permitted = mode_ == Mode::kInstallation;
    if (permitted) {
      configuration_.assign(content.begin() + 1, content.end());
      ++configurations_written_;
    }
    std::vector<std::uint8_t> bytes{0xF7, static_cast<std::uint8_t>(permitted)};
    bytes.insert(bytes.end(), configuration_.begin(), configuration_.end());
    answer(std::move(bytes), utime);
  } else {
    enqueue({0x15}, utime + kAnswerUs, 0);
  }
}

void LmsEmulator::execute_mode(std::span<const std::uint8_t> content, std::int64_t utime) {
  constexpr std::uint8_t kOk = 0;
  constexpr std::uint8_t kWrongPassword = 1;
  switch (content[1]) {
    case 0x00: {
      const std::string password(content.begin() + 2, content.end());
      const bool right = password == params_.password;
      if (right) mode_ = Mode::kInstallation;
      answer({0xA0, right ? kOk : kWrongPassword}, utime);
      break;
    }
    case 0x24:
      mode_ = Mode::kContinuous;
      answer({0xA0, kOk}, utime);
      break;
    case 0x25:
      mode_ = Mode::kOnRequest;
      answer({0xA0, kOk}, utime);
      break;
    case 0x40:
      answer({0xA0, kOk}, utime, 38400);
      break;
    case 0x41:
      answer({0xA0, kOk}, utime, 19200);
      break;
    case 0x42:
      answer({0xA0, kOk}, utime, 9600);
      break;
    case 0x48:
      answer({0xA0, kOk}, utime, 500000);
      break;
    default:
      answer({0xA0, 2}, utime);
      break;
  }
}

void LmsEmulator::answer(std::vector<std::uint8_t> content, std::int64_t utime, int baud_after) {
  std::vector<std::uint8_t> bytes{0x06};
  const std::vector<std::uint8_t> telegram = frame(content);
  bytes.insert(bytes.end(), telegram.begin(), telegram.end());
  enqueue(std::move(bytes), utime + kAnswerUs, baud_after);
}

void LmsEmulator::enqueue(std::vector<std::uint8_t> bytes, std::int64_t start, int baud_after) {
  pending_.push_back({start, std::move(bytes), baud_after});
}

std::vector<std::uint8_t> LmsEmulator::scan_telegram(int scan) const {
  std::vector<std::uint8_t> content{0xB0};
  append_word(content,
              static_cast<unsigned>(beams()) + (configuration_[kUnitAt] == 1 ? 0x4000U : 0U));
  for (int beam = 0; beam < beams(); ++beam) append_word(content, reading_(scan, beam) % 0x2000U);
  return frame(content);
}

std::int64_t LmsEmulator::scan_start(int scan) const {
  return starts_.at(static_cast<std::size_t>(scan));
}

/// Scans end at fixed times. One is sent if the line is free then; otherwise it is lost.
void LmsEmulator::measure(std::int64_t until) {
  const double period_us = 1e6 * params_.turn_s * turns();
  const double duration_us = 1e6 * params_.turn_s * (turns() - 1 + field_of_view_deg_ / 360.0);
  while (true) {
    const double start_us =
        static_cast<double>(mirror_zero_) + static_cast<double>(next_scan_) * period_us;
    const auto end = std::llround(start_us + duration_us);
    if (end > until) return;
    ++next_scan_;
    if (mode_ != Mode::kContinuous || end < booted_ || end < line_free_ || !pending_.empty())
      continue;
    const int scan = static_cast<int>(starts_.size());
    starts_.push_back(std::llround(start_us));
    enqueue(scan_telegram(scan), end + std::llround(1e6 * params_.processing_s), 0);
    return;
  }
}

std::vector<TimedByte> LmsEmulator::advance(std::int64_t utime, int host_baud) {
  if (!is_on_) return {};
  if (!announced_ && utime >= booted_) {
    announced_ = true;
    const std::string type = "LMS200;301063;V02.10 ";
    std::vector<std::uint8_t> content{0x90};
    content.insert(content.end(), type.begin(), type.end());
    enqueue(frame(content), booted_, 0);
  }
  while (true) {
    if (pending_.empty()) measure(utime);
    if (pending_.empty() || pending_.front().start > utime) break;
    const Pending next = std::move(pending_.front());
    pending_.pop_front();
    double at_us = static_cast<double>(std::max(next.start, line_free_));
    for (const std::uint8_t byte : next.bytes) {
      at_us += 1e7 / baud_;
      line_.push_back(
          {std::llround(at_us), host_baud == baud_ ? byte : static_cast<std::uint8_t>(random_())});
    }
    line_free_ = std::llround(at_us);
    if (next.baud_after != 0) baud_ = next.baud_after;
  }
  return take_due(line_, utime);
}

}  // namespace adit
