// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/node/recorded_section.hpp"
#include "common/sensing/laser_mount.hpp"
#include "tools/log_times/time_choice.hpp"
#include "tools/ros/import/topic_choice.hpp"

namespace adit {

/// Whether the file is an LCM log, plain or compressed, by its first bytes or its extension.
bool is_lcm_log(const std::filesystem::path& file);

/// An LCM log, a CARMEN log or a bag of ROS for replay, in order of time and with usable times
/// (TimeJudge). A log in order is read in constant memory, another one with an index of its events.
class LogInput {
 public:
  /// Opens an LCM log, or converts a CARMEN log (plain or gzip) or `topics` of a bag to an LCM log
  /// in `scratch` first. `progress` is called meanwhile. Throws std::runtime_error for an unusable
  /// file.
  LogInput(const std::filesystem::path& path, const TopicChoice& topics,
           const std::filesystem::path& scratch, const std::function<void(double)>& progress);

  [[nodiscard]] EventSource& events() { return *events_; }
  /// Laser mounts of the first CONFIG that has them; nothing if none has. An unreadable CONFIG adds
  /// a warning.
  [[nodiscard]] std::optional<Lasers> recorded_lasers(std::vector<std::string>& warnings) const;
  /// Whether `adit import` made the log, so that its 3D scans have poses by odometry.
  [[nodiscard]] bool is_imported() const { return is_imported_; }
  /// The times that the readings have.
  [[nodiscard]] const TimeChoice& times() const { return times_; }
  /// Scans in the log, with those that cannot be used.
  [[nodiscard]] std::size_t scans() const { return scans_; }
  /// Skipped parts of the log, without a verb: "12 corrupt bytes in 1 place".
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  /// Assumptions in the conversion of the log, sentences.
  [[nodiscard]] const std::vector<std::string>& assumptions() const { return assumptions_; }

 private:
  void open_bag(const std::filesystem::path& path, const TopicChoice& topics,
                const std::filesystem::path& scratch, const std::function<void(double)>& progress);
  void open_lcm_log(const std::filesystem::path& path, const std::function<void(double)>& progress);

  std::vector<std::string> warnings_;
  std::vector<std::string> assumptions_;
  std::optional<Lasers> lasers_;
  std::vector<std::string> config_warnings_;
  TimeChoice times_;
  std::size_t scans_ = 0;
  bool is_imported_ = false;
  std::unique_ptr<EventSource> events_;
};

/// Laser mounts of an event if it is a CONFIG that has them. An unreadable CONFIG adds a warning.
std::optional<Lasers> recorded_lasers(const LogEventView& event,
                                      std::vector<std::string>& warnings);
/// Those of the first event that has them; nothing if none has.
std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events,
                                      std::vector<std::string>& warnings);

}  // namespace adit
