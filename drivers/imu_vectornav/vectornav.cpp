// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/imu_vectornav/vectornav.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr int kAttempts = 3;
constexpr std::int64_t kAnswerTimeoutUs = 300'000;
constexpr std::int64_t kReadingTimeoutUs = 500'000;
constexpr std::array kRatesHz{1, 2, 4, 5, 10, 20, 25, 40, 50, 100, 200};

// Beyond what any of the units measures.
constexpr double kForceMaxM_S2 = 500.0;
constexpr double kTurnMaxRad_S = 50.0;

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Three numbers from this field on. Nothing if one is none, or not below `max`.
std::optional<Eigen::Vector3d> vector_in(const std::vector<std::string>& fields, std::size_t first,
                                         double max) {
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = number_in(fields[first + i]);
    if (!number || !(std::abs(*number) < max)) return std::nullopt;
    vector[static_cast<Eigen::Index>(i)] = *number;
  }
  return vector;
}

Eigen::Matrix3d rotation(const VectorNavParams& params) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(deg_to_rad(params.yaw_deg), Vector3d::UnitZ()) *
          AngleAxisd(deg_to_rad(params.pitch_deg), Vector3d::UnitY()) *
          AngleAxisd(deg_to_rad(params.roll_deg), Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

VectorNav::VectorNav(const VectorNavParams& params)
    : params_(params),
      R_body_imu_(rotation(params)),
      bauds_(params.baud, {115200, 230400, 921600, 460800, 57600, 9600}),
      baud_(params.baud),
      counter_(1e6 / params.rate_hz) {
  if (std::ranges::find(kRatesHz, params.rate_hz) == kRatesHz.end()) {
    throw std::invalid_argument(fmt::format("rate_hz is {}: it must be one of {}", params.rate_hz,
                                            fmt::join(kRatesHz, ", ")));
  }
}

std::vector<PortRequest> VectorNav::take_requests() { return std::exchange(requests_, {}); }

void VectorNav::request_baud(int baud) {
  baud_ = baud;
  decoder_.clear();
  requests_.push_back({baud, {}});
}

void VectorNav::start(std::int64_t now_us) {
  bauds_.found();
  problem_.clear();
  search(now_us, {});
}

void VectorNav::search(std::int64_t now_us, const std::string& why) {
  if (!why.empty()) problem_ = why;
  counter_.reset();
  averaged_ = 0;
  mean_force_body_.reset();
  request_baud(bauds_.current());
  enter(Step::kFind, now_us);
}

void VectorNav::enter(Step step, std::int64_t now_us) {
  step_ = step;
  attempts_ = 0;
  rejection_.clear();
  send(now_us);
}

/// Without checksum and end.
std::string VectorNav::command() const {
  switch (step_) {
    case Step::kFind:
    case Step::kVerifyBaud:
      return "VNRRG,01";  // model
    case Step::kBaud:
      return fmt::format("VNWRG,05,{}", params_.baud);
    case Step::kChecksum:  // no counters, checksum of 16 bits on the serial line, errors reported
      return "VNWRG,30,0,0,0,0,3,0,1";
    case Step::kRate:
      return fmt::format("VNWRG,07,{}", params_.rate_hz);
    case Step::kOutput:
      return fmt::format("VNWRG,06,{}", params_.output == "imu" ? 19 : 14);
    case Step::kStream:
      return {};
  }
  return {};
}

void VectorNav::send(std::int64_t now_us) {
  ++attempts_;
  if (step_ == Step::kStream) {
    deadline_us_ = now_us + std::max(kReadingTimeoutUs, std::int64_t{5'000'000} / params_.rate_hz);
    return;
  }
  deadline_us_ = now_us + kAnswerTimeoutUs;
  requests_.push_back({std::nullopt, encode_vn_line(command())});
}

void VectorNav::tick(std::int64_t now_us) {
  if (now_us < deadline_us_) return;
  if (step_ == Step::kStream) {
    search(now_us, "it stopped sending");
  } else if (step_ == Step::kFind) {
    if (attempts_ < 2) return send(now_us);  // the first ends what was sent at a wrong baud rate
    const bool all_tried = bauds_.advance();
    search(now_us, all_tried ? "no answer at any baud rate" : "");
  } else if (step_ == Step::kBaud && attempts_ >= kAttempts - 1) {
    advance(now_us);  // the answer may have come at the new rate
  } else if (attempts_ < kAttempts) {
    send(now_us);
  } else {
    search(now_us,
           rejection_.empty() ? fmt::format("no answer while {}", step_text()) : rejection_);
  }
}

std::vector<ImuReading> VectorNav::receive(std::span<const std::uint8_t> bytes,
                                           std::int64_t now_us) {
  std::vector<ImuReading> readings;
  decoder_.add(bytes, now_us, byte_us());
  while (const auto line = decoder_.next()) {
    if (step_ != Step::kStream) {
      process_answer(*line, now_us);
    } else if (auto reading = reading_of(*line, now_us)) {
      watch_gravity(*reading);
      readings.push_back(*reading);
      problem_.clear();
      send(now_us);  // extends the deadline
    }
  }
  return readings;
}

void VectorNav::process_answer(const VnLine& line, std::int64_t now_us) {
  bauds_.found();
  if (line.header == "VNERR") {
    rejection_ = fmt::format("the unit rejects {} with error {}", quote(command()),
                             line.fields.empty() ? "" : quote(line.fields[0]));
    return;
  }
  const std::string sent = command();
  const bool is_read = line.header == "VNRRG" && sent.starts_with("VNRRG") &&
                       !line.fields.empty() && line.fields[0] == "01";
  const bool is_written = line.header == "VNWRG" && sent.starts_with("VNWRG") &&
                          !line.fields.empty() && line.fields[0] == sent.substr(6, 2);
  if (is_read || is_written) advance(now_us);
}

/// The current step is done.
void VectorNav::advance(std::int64_t now_us) {
  switch (step_) {
    case Step::kFind:
      return enter(baud_ == params_.baud ? Step::kChecksum : Step::kBaud, now_us);
    case Step::kBaud:
      request_baud(params_.baud);
      return enter(Step::kVerifyBaud, now_us);
    case Step::kVerifyBaud:
      return enter(Step::kChecksum, now_us);
    case Step::kChecksum:
      return enter(Step::kRate, now_us);
    case Step::kRate:
      return enter(Step::kOutput, now_us);
    case Step::kOutput:
      counter_.reset();
      return enter(Step::kStream, now_us);
    case Step::kStream:
      return;
  }
}

/// Latest time at which a line can have arrived that was read at `now_us`: the lines behind it in
/// the same read, whole or not, began a period apart. Read late, several are there at once.
std::int64_t VectorNav::arrival_us(const VnLine& line, std::int64_t now_us) const {
  constexpr double kLengthTolerance = 0.05;  // a field may be longer by a character
  const double period_us = 1e6 / params_.rate_hz;
  const double behind = static_cast<double>(now_us - line.end_us) / byte_us();  // bytes
  const auto line_bytes = static_cast<double>(line.bytes);
  const double lines = std::floor(behind / line_bytes + kLengthTolerance);
  const double begun = behind - lines * line_bytes;  // of the next line
  const double pause_us = std::max(0.0, period_us - line_bytes * byte_us());
  const double since_us = lines * period_us + (begun > 0.5 ? pause_us + begun * byte_us() : 0.0);
  return now_us - std::llround(since_us);
}

std::optional<ImuReading> VectorNav::reading_of(const VnLine& line, std::int64_t now_us) {
  // IMU: magnetic field, acceleration, rates, temperature, pressure. YMR: yaw, pitch, roll, then
  // the first three.
  const bool is_imu = params_.output == "imu";
  const std::size_t fields = is_imu ? 11 : 12;
  const std::size_t force_at = is_imu ? 3 : 6;
  if (!line.has_crc || line.header != (is_imu ? "VNIMU" : "VNYMR") ||
      line.fields.size() != fields) {
    return std::nullopt;
  }
  const auto force = vector_in(line.fields, force_at, kForceMaxM_S2);
  const auto turn = vector_in(line.fields, force_at + 3, kTurnMaxRad_S);
  const auto arrived_us = counter_.arrival_us(arrival_us(line, now_us));
  if (!force || !turn || !arrived_us) return std::nullopt;
  const double line_us = static_cast<double>(line.bytes) * byte_us();
  return ImuReading{*arrived_us - std::llround(line_us + 1000.0 * params_.delay_ms),
                    R_body_imu_ * *turn, R_body_imu_ * *force};
}

/// Over some seconds the specific force points up, whatever the vehicle does.
void VectorNav::watch_gravity(const ImuReading& reading) {
  const double share = 1.0 / std::min(++averaged_, 10 * params_.rate_hz);
  if (!mean_force_body_) mean_force_body_ = Eigen::Vector3d::Zero();
  *mean_force_body_ += share * (reading.linear_acceleration - *mean_force_body_);
}

DeviceProtocol::LineCounts VectorNav::line_counts() const {
  return {decoder_.counts().lines, decoder_.counts().corrupt};
}

std::string VectorNav::step_text() const {
  switch (step_) {
    case Step::kFind:
      return fmt::format("searching the unit at {} baud", baud_);
    case Step::kBaud:
    case Step::kVerifyBaud:
      return fmt::format("changing to {} baud", params_.baud);
    case Step::kChecksum:
    case Step::kRate:
    case Step::kOutput:
      return "setting the output";
    case Step::kStream:
      return "measuring";
  }
  return {};
}

std::string VectorNav::problem() const {
  constexpr double kUpMinM_S2 = 6.0;  // of 9.8: leaning by less than half a radian, or accelerating
  if (!rejection_.empty()) return rejection_;
  if (step_ != Step::kStream) {
    return problem_.empty() ? step_text() : fmt::format("{}: {}", problem_, step_text());
  }
  if (averaged_ > 2 * params_.rate_hz && mean_force_body_->z() < kUpMinM_S2) {
    return fmt::format(
        "the mean specific force in the body frame is {:.1f}, {:.1f}, {:.1f} m/s², not upwards: "
        "correct roll_deg, pitch_deg, yaw_deg",
        mean_force_body_->x(), mean_force_body_->y(), mean_force_body_->z());
  }
  return {};
}

}  // namespace adit
