// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/drive/key_driver.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr int kSteps = 5;
constexpr char kEscape = '\x1b';

std::optional<DriveKey> letter(char byte) {
  switch (byte) {
    case 'w':
      return DriveKey::kFaster;
    case 's':
      return DriveKey::kSlower;
    case 'a':
      return DriveKey::kLeft;
    case 'd':
      return DriveKey::kRight;
    case ' ':
      return DriveKey::kStop;
    case 'q':
      return DriveKey::kQuit;
    default:
      return std::nullopt;
  }
}

/// The last byte of `ESC [ A` or `ESC O A`.
std::optional<DriveKey> arrow(char byte) {
  switch (byte) {
    case 'A':
      return DriveKey::kFaster;
    case 'B':
      return DriveKey::kSlower;
    case 'C':
      return DriveKey::kRight;
    case 'D':
      return DriveKey::kLeft;
    default:
      return std::nullopt;
  }
}

int changed(int steps, int by) { return std::clamp(steps + by, -kSteps, kSteps); }

}  // namespace

std::vector<DriveKey> KeyReader::read(std::string_view bytes) {
  std::vector<DriveKey> keys;
  for (const char byte : bytes) {
    if (const auto key = read_one(byte)) keys.push_back(*key);
  }
  return keys;
}

std::optional<DriveKey> KeyReader::read_one(char byte) {
  if (byte == kEscape) {
    escape_ = 1;
    return std::nullopt;
  }
  if (escape_ == 1 && (byte == '[' || byte == 'O')) {
    escape_ = 2;
    return std::nullopt;
  }
  const bool ends_sequence = escape_ == 2;
  escape_ = 0;
  return ends_sequence ? arrow(byte) : letter(byte);
}

void KeyDriver::press(DriveKey key) {
  switch (key) {
    case DriveKey::kFaster:
      speed_steps_ = changed(speed_steps_, 1);
      break;
    case DriveKey::kSlower:
      speed_steps_ = changed(speed_steps_, -1);
      break;
    case DriveKey::kLeft:
      curvature_steps_ = changed(curvature_steps_, 1);
      break;
    case DriveKey::kRight:
      curvature_steps_ = changed(curvature_steps_, -1);
      break;
    case DriveKey::kStop:
      speed_steps_ = curvature_steps_ = 0;
      break;
    case DriveKey::kQuit:
      quits_ = true;
      break;
  }
}

DriveCommand KeyDriver::command(std::int64_t utime) const {
  const double step_m_s = vehicle_.speed_max_m_s / kSteps;
  const double step_1_m = 1.0 / vehicle_.turning_radius_m / kSteps;
  return {utime, speed_steps_ * step_m_s, curvature_steps_ * step_1_m};
}

}  // namespace adit
