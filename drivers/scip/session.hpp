// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/laser/laser_device.hpp"
#include "drivers/scip/parameters.hpp"
#include "drivers/scip/response.hpp"

#include "common/config/bounds.hpp"
#include "common/sensing/laser_mount.hpp"

namespace adit {

/// The section of one laser.
struct ScipParams {
  std::string device = "/dev/ttyACM0";
  int baud = 115200;   ///< of a serial line; USB and TCP have none
  int characters = 3;  ///< for each distance: 3, or 2 up to 4.095 m, which takes less time
  double angle_min_deg = -180.0;
  double angle_max_deg = 180.0;  ///< what the laser does not measure of these is left out
  bool upside_down = false;      ///< mounted so; its beams are then published in reverse order
  double delay_ms = 0.0;         ///< of the stamp of the laser behind its first beam
  Lasers lasers;

  template <class V>
  void visit(V& v) {
    v("device", device);
    v("baud", baud, within(9600, 921600));
    v("characters", characters, within(2, 3));
    v("angle_min_deg", angle_min_deg, within(-180.0, 180.0));
    v("angle_max_deg", angle_max_deg, within(-180.0, 180.0));
    v("upside_down", upside_down);
    v("delay_ms", delay_ms, within(-1000.0, 1000.0));
    v.shared(Lasers::kSection, lasers);
  }
};

/// The conversation with one laser, without port or clock: finds the baud rate at which it answers,
/// changes it, reads the parameters, asks for its time, and starts the continuous output (MD or
/// MS). Begins again when no scan arrives for some time. A session never gives up.
class ScipSession {
 public:
  struct Scan {
    ScipReadings readings;
    int first_step = 0;
    std::int64_t end_us = 0;  ///< arrival of the last byte
    std::size_t bytes = 0;    ///< on the line
  };

  /// The laser was asked for its time.
  struct TimeAnswer {
    std::uint32_t time_ms = 0;
    std::int64_t asked_us = 0;
    std::int64_t answered_us = 0;
  };

  explicit ScipSession(const ScipParams& params);

  /// The port was opened, or opened again. Times are those of a clock that does not jump [µs].
  void start(std::int64_t now_us);

  /// Bytes that were read at this time. Returns the scans that are complete with them.
  std::vector<Scan> receive(std::span<const std::uint8_t> bytes, std::int64_t now_us);

  /// To be called every 50 ms or so, for timeouts.
  void tick(std::int64_t now_us);

  std::vector<PortRequest> take_requests();
  std::vector<TimeAnswer> take_time_answers();

  [[nodiscard]] bool is_streaming() const { return step_ == Step::kStream; }
  /// What is being done, and why it has failed so far; one clause.
  [[nodiscard]] std::string status_text() const;
  /// Known once it streams.
  [[nodiscard]] const std::optional<ScipParameters>& laser() const { return laser_; }
  [[nodiscard]] const ScipDecoder::Counts& line_counts() const { return decoder_.counts(); }
  [[nodiscard]] double byte_us() const { return has_baud_ ? 1e7 / baud_ : 0.0; }
  /// Number of beams that are asked for; those of the settings that the laser has.
  [[nodiscard]] int beams() const { return last_step_ - first_step_ + 1; }

 private:
  /// In this order; those that are not needed are skipped.
  enum class Step {
    kFind,        ///< a baud rate at which the laser answers; its output ends
    kBaud,        ///< the baud rate of the settings
    kVerifyBaud,  ///< whether it answers at that
    kParameters,
    kTimeOn,  ///< the mode in which it tells its time
    kTime,
    kTimeOff,
    kLaserOn,
    kStart,  ///< the continuous output
    kStream
  };

  void search(std::int64_t now_us, std::string_view why);
  void enter(Step step, std::int64_t now_us);
  void send_request(std::int64_t now_us);
  void repeat_or_search(std::int64_t now_us);
  void request_baud(int baud);
  [[nodiscard]] std::string command() const;
  [[nodiscard]] std::string step_text() const;
  void process_answer(const ScipResponse& response, std::int64_t now_us);
  void process_parameters(const ScipResponse& response, std::int64_t now_us);
  void process_time(const ScipResponse& response, std::int64_t now_us);
  std::optional<Scan> scan_of(const ScipResponse& response) const;
  [[nodiscard]] std::int64_t scan_timeout_us() const;

  ScipParams params_;
  bool has_baud_;
  ScipDecoder decoder_;
  std::vector<PortRequest> requests_;
  std::vector<TimeAnswer> times_;
  Step step_ = Step::kFind;
  std::deque<int> bauds_;
  int baud_ = 0;
  int attempts_ = 0;
  int times_asked_ = 0;
  std::int64_t asked_us_ = 0;
  std::int64_t deadline_us_ = 0;
  std::optional<ScipParameters> laser_;
  int first_step_ = 0;
  int last_step_ = -1;
  std::string rejection_;  ///< of the current request by the laser
  std::string problem_;    ///< of the last attempt
};

}  // namespace adit
