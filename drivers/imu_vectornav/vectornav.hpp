// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "drivers/device/baud_search.hpp"
#include "drivers/device/device_protocol.hpp"
#include "drivers/imu_vectornav/line.hpp"
#include "drivers/timing/scan_counter.hpp"

#include "common/config/bounds.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

struct VectorNavParams {
  std::string device = "/dev/ttyUSB0";
  int baud = 230400;           ///< 115200 is too slow for 100 readings per second
  int rate_hz = 100;           ///< 1, 2, 4, 5, 10, 20, 25, 40, 50, 100 or 200
  std::string output = "imu";  ///< as measured; "ymr": without the biases that its filter estimates
  double roll_deg = 180.0;     ///< R_body_imu = Rz(yaw) Ry(pitch) Rx(roll); x forward, z down
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;
  double delay_ms = 0.0;  ///< from a measurement to its first byte, if it was measured

  template <class V>
  void visit(V& v) {
    v("device", device);
    v("baud", baud, within(9600, 921600));
    v("rate_hz", rate_hz, within(1, 200));
    v("output", output, OneOf({"imu", "ymr"}));
    v("roll_deg", roll_deg, within(-360.0, 360.0));
    v("pitch_deg", pitch_deg, within(-360.0, 360.0));
    v("yaw_deg", yaw_deg, within(-360.0, 360.0));
    v("delay_ms", delay_ms, within(-100.0, 100.0));
  }
};

/// An IMU of VectorNav (VN-100, VN-200, VN-300) by its ASCII protocol, without port or clock: bytes
/// in, readings in the body frame and requests out. Finds the baud rate, changes it, sets rate and
/// kind of the output and a checksum of 16 bits, all until it is switched off. The unit sends no
/// time: readings are taken at multiples of the period, ScanCounter finds which one arrived.
class VectorNav final : public ReadingDevice<ImuReading> {
 public:
  using Params = VectorNavParams;

  /// Throws std::invalid_argument, with the remedy, for a rate that the units do not have.
  explicit VectorNav(const VectorNavParams& params);

  void start(std::int64_t now_us) override;
  std::vector<ImuReading> receive(std::span<const std::uint8_t> bytes,
                                  std::int64_t now_us) override;
  void tick(std::int64_t now_us) override;
  std::vector<PortRequest> take_requests() override;
  [[nodiscard]] bool is_streaming() const override { return step_ == Step::kStream; }
  [[nodiscard]] std::string problem() const override;
  [[nodiscard]] LineCounts line_counts() const override;

 private:
  /// In this order; those that are not needed are skipped.
  enum class Step {
    kFind,  ///< a baud rate at which it answers
    kBaud,  ///< the one of the configuration
    kVerifyBaud,
    kChecksum,  ///< of 16 bits
    kRate,
    kOutput,
    kStream
  };

  void search(std::int64_t now_us, const std::string& why);
  void enter(Step step, std::int64_t now_us);
  void send(std::int64_t now_us);
  void request_baud(int baud);
  [[nodiscard]] std::string command() const;
  [[nodiscard]] std::string step_text() const;
  void process_answer(const VnLine& line, std::int64_t now_us);
  void advance(std::int64_t now_us);
  std::optional<ImuReading> reading_of(const VnLine& line, std::int64_t now_us);
  [[nodiscard]] std::int64_t arrival_us(const VnLine& line, std::int64_t now_us) const;
  void watch_gravity(const ImuReading& reading);
  [[nodiscard]] double byte_us() const { return 1e7 / baud_; }

  VectorNavParams params_;
  Eigen::Matrix3d R_body_imu_;
  BaudSearch bauds_;
  int baud_;
  VnDecoder decoder_;
  std::vector<PortRequest> requests_;
  Step step_ = Step::kFind;
  int attempts_ = 0;
  std::int64_t deadline_us_ = 0;
  std::string rejection_;  ///< of the current request by the unit
  std::string problem_;    ///< of the last attempt
  ScanCounter counter_;
  std::optional<Eigen::Vector3d> mean_force_body_;  ///< over some seconds [m/s²]
  int averaged_ = 0;                                ///< readings
};

}  // namespace adit
