// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/log_input.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/files/zstd_stream.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/sensing.hpp"
#include "tools/carmen/carmen_import.hpp"
#include "tools/log_times/time_assignment.hpp"
#include "tools/map/reading_times.hpp"
#include "tools/ros/bag/bag_files.hpp"
#include "tools/ros/import/bag_import.hpp"
#include "tools/ros/import/cloud_sequence_import.hpp"

namespace adit {
namespace {

std::vector<std::string> log_warnings(const LogHealth& health) {
  std::vector<std::string> warnings;
  if (health.corrupt_bytes > 0) {
    warnings.push_back(fmt::format("{} corrupt bytes in {} regions", health.corrupt_bytes,
                                   health.corrupt_regions));
  }
  if (health.truncated_bytes > 0) warnings.emplace_back("the last event, which is truncated");
  return warnings;
}

bool is_config_of_import(const LogEventView& event) {
  if (event.channel != channels::kConfig) return false;
  const auto message = decode<config_t>(event.data);
  return message && message->stage == kImportStage;
}

/// What the first pass over an LCM log finds.
struct LogSurvey {
  std::size_t events = 0;
  std::size_t scans = 0;
  bool in_order = true;  ///< by the times of recording
  bool logged_usable = true;
  bool imported = false;
  LogHealth health;
  TimeChoice times;
  std::optional<Lasers> lasers;
  std::vector<std::string> config_warnings;
};

LogSurvey survey(const std::filesystem::path& path, const std::function<void(double)>& progress) {
  LogSurvey found;
  LogReader reader(path);
  TimeJudge judge;
  std::int64_t latest = 0;
  while (const auto event = reader.next()) {
    ++found.events;
    if (laser_from_channel(event->channel)) ++found.scans;
    found.in_order = found.in_order && event->utime >= latest;
    latest = event->utime;
    add_times(*event, judge);
    if (!found.lasers) found.lasers = recorded_lasers(*event, found.config_warnings);
    found.imported = found.imported || is_config_of_import(*event);
    progress(reader.fraction_read());
  }
  if (found.events == 0 && !reader.empty()) {
    throw std::runtime_error(path.string() + ": not an LCM log");
  }
  found.health = reader.health();
  found.times = judge.choose();
  found.logged_usable = judge.logged_usable();
  return found;
}

/// Gives each event its time for replay: a reading the chosen one, another event that of recording
/// or, if times are assumed, that of the reading before it.
LogFile::TimeOf replay_time(const TimeChoice& times) {
  return [assignment = TimeAssignment(times),
          latest = times.start_utime](const LogEventView& event) mutable {
    const bool by_order = assignment.choice().source == TimeChoice::Source::kOrder;
    if (!is_reading(event)) return by_order ? latest : event.utime;
    const std::int64_t utime = assignment.next(event.channel, recorded_times(event));
    return latest = utime > 0 ? utime : event.utime;
  };
}

}  // namespace

bool is_lcm_log(const std::filesystem::path& file) {
  if (file.extension() == ".lcmlog") return true;
  std::ifstream stream(file, std::ios::binary);
  constexpr std::array<std::uint8_t, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
  std::array<std::uint8_t, 4> begin{};
  stream.read(reinterpret_cast<char*>(begin.data()), begin.size());
  return stream.good() && (begin == kSync || is_zstd(begin));
}

LogInput::LogInput(const std::filesystem::path& path, const TopicChoice& topics,
                   const std::filesystem::path& scratch,
                   const std::function<void(double)>& progress) {
  if (!std::ifstream(path)) throw std::runtime_error(fmt::format("cannot read {}", path.string()));
  if (is_bag(path)) {
    open_bag(path, topics, scratch, progress);
  } else if (is_cloud_folder(path)) {
    CloudSequenceImport clouds = import_cloud_sequence(path, scratch, {}, progress);
    open_lcm_log(scratch, progress);
    std::filesystem::remove(scratch);  // the open file stays readable
    warnings_ = std::move(clouds.skipped);
    assumptions_ = std::move(clouds.warnings);
  } else if (is_lcm_log(path)) {
    open_lcm_log(path, progress);
  } else {
    const CarmenReport report = import_carmen(path, scratch, progress);
    open_lcm_log(scratch, progress);
    std::filesystem::remove(scratch);  // the open file stays readable
    warnings_ = report.messages();
    times_ = report.times;
    scans_ = report.scans + report.rejected_scans;
  }
}

void LogInput::open_bag(const std::filesystem::path& path, const TopicChoice& topics,
                        const std::filesystem::path& scratch,
                        const std::function<void(double)>& progress) {
  BagImport bag = import_bag(path, scratch, {topics}, progress);
  open_lcm_log(scratch, progress);
  std::filesystem::remove(scratch);  // the open file stays readable
  warnings_ = std::move(bag.skipped);
  assumptions_ = std::move(bag.warnings);
  scans_ = bag.scans + bag.rejected_scans;
}

void LogInput::open_lcm_log(const std::filesystem::path& path,
                            const std::function<void(double)>& progress) {
  LogSurvey found = survey(path, progress);
  warnings_ = log_warnings(found.health);
  lasers_ = found.lasers;
  config_warnings_ = std::move(found.config_warnings);
  times_ = found.times;
  scans_ = found.scans;
  is_imported_ = found.imported;
  const bool as_measured = times_.source == TimeChoice::Source::kMeasured;
  if (as_measured && found.logged_usable && times_.late == 0) {
    if (found.in_order) {
      events_ = std::make_unique<LogStream>(path, found.events);
    } else {
      events_ = std::make_unique<LogFile>(path);
    }
    return;
  }
  events_ = std::make_unique<LogFile>(path, replay_time(times_));
  if (!as_measured) events_ = std::make_unique<RestampedEvents>(std::move(events_));
}

std::optional<Lasers> LogInput::recorded_lasers(std::vector<std::string>& warnings) const {
  warnings.insert(warnings.end(), config_warnings_.begin(), config_warnings_.end());
  return lasers_;
}

std::optional<Lasers> recorded_lasers(const LogEventView& event,
                                      std::vector<std::string>& warnings) {
  if (event.channel != channels::kConfig) return std::nullopt;
  const auto message = decode<config_t>(event.data);
  if (!message) return std::nullopt;
  const auto snapshot = from_message(*message);
  if (!snapshot) return std::nullopt;
  return recorded_section<Lasers>(*snapshot, Lasers::kSection, warnings);
}

std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events,
                                      std::vector<std::string>& warnings) {
  for (const LogEventView& event : events) {
    if (auto lasers = recorded_lasers(event, warnings)) return lasers;
  }
  return std::nullopt;
}

}  // namespace adit
