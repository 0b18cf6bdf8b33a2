// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/laser/laser_device.hpp"
#include "drivers/sick_lms2xx/measured_values.hpp"
#include "drivers/sick_lms2xx/settings.hpp"
#include "drivers/sick_lms2xx/telegram.hpp"

namespace adit {

/// The conversation with one laser, without port or clock: finds the baud rate at which it answers,
/// sets baud rate, unit, field of view and angular step where they differ, and starts the
/// continuous output of all readings (mode 24h). Begins again when the laser reports that it was
/// switched on (90h), or no scan arrives for some time. A session never gives up.
class LmsSession {
 public:
  struct Scan {
    LmsMeasuredValues values;
    std::uint8_t status = 0;
    std::int64_t end_us = 0;  ///< arrival of the last byte
  };

  struct Counts {
    std::int64_t scans = 0;
    std::int64_t rejected = 0;  ///< scans that do not fit the settings
    std::int64_t losses = 0;    ///< of the connection, after it was established
  };

  /// Throws as LmsSettings::require_valid does.
  explicit LmsSession(const LmsSettings& settings);

  /// The port was opened, or opened again. Times are those of a clock that does not jump [µs].
  void start(std::int64_t now_us);

  /// Bytes that were read at this time. Returns the scans that are complete with them.
  std::vector<Scan> receive(std::span<const std::uint8_t> bytes, std::int64_t now_us);

  /// To be called every 50 ms or so, for timeouts.
  void tick(std::int64_t now_us);

  std::vector<PortRequest> take_requests();

  /// Whether the laser measures and sends.
  [[nodiscard]] bool is_streaming() const { return step_ == Step::kStream; }
  /// What is being done, and why it has failed so far; one clause.
  [[nodiscard]] std::string status_text() const;
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] const LmsDecoder::Counts& line_counts() const { return decoder_.counts(); }

 private:
  /// In this order; those whose result is right already are skipped.
  enum class Step {
    kFind,         ///< a baud rate at which the laser answers
    kBaud,         ///< the baud rate of the settings
    kVerifyBaud,   ///< whether it answers at that
    kReadConfig,   ///< unit and measuring mode
    kLogin,        ///< by the password
    kWriteConfig,  ///< into the permanent memory of the laser
    kVariant,      ///< field of view and angular step
    kStart,        ///< the continuous output
    kStream
  };

  void search(std::int64_t now_us, std::string_view why);
  void enter(Step step, std::int64_t now_us);
  void send_request(std::int64_t now_us);
  void repeat_or_search(std::int64_t now_us);
  void request_baud(int baud);
  void send(std::span<const std::uint8_t> content);
  void process(const LmsTelegram& telegram, std::int64_t now_us, std::vector<Scan>& scans);
  void process_answer(const LmsTelegram& telegram, std::int64_t now_us);
  void process_config(const LmsTelegram& telegram, std::int64_t now_us);
  std::optional<Scan> scan_of(const LmsTelegram& telegram);
  [[nodiscard]] std::string step_text() const;
  [[nodiscard]] double byte_us() const { return 1e7 / baud_; }
  [[nodiscard]] std::int64_t answer_timeout_us() const;
  [[nodiscard]] std::int64_t scan_timeout_us() const;

  LmsSettings settings_;
  LmsDecoder decoder_;
  std::vector<PortRequest> requests_;
  Step step_ = Step::kFind;
  std::deque<int> bauds_;  ///< still to be tried, the current one first
  int baud_ = 0;
  int attempts_ = 0;  ///< of the current request
  std::int64_t deadline_us_ = 0;
  std::vector<std::uint8_t> config_;  ///< to be written
  bool sends_scans_ = false;          ///< at the baud rate that is being tried
  std::string rejection_;             ///< of the current request by the laser
  std::string problem_;               ///< of the last attempt
  int misfits_ = 0;                   ///< scans that do not fit the settings, one after the other
  Counts counts_;
};

}  // namespace adit
