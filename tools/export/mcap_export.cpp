// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/mcap_export.hpp"

#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/log/event_source.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/version.hpp"
#include "common/messages/fields/quantities.hpp"
#include "common/text/base64.hpp"
#include "tools/export/mcap_writer.hpp"
#include "viewer/scene/scene.hpp"

namespace adit {
namespace {

constexpr std::int64_t kWritePeriodUs = 10'000;  // topics have longer periods, or none
// A topic of large messages (map, volume) is written as rarely as keeps it below this rate, and at
// the end.
constexpr double kTopicBytesPerUs = 0.1;
constexpr std::int64_t kGapMaxUs = 24LL * 3600 * 1'000'000;  // longer ones are damaged times
constexpr std::size_t kEventsPerProgress = 10'000;

McapWriter::Schema schema_of(const Topic& topic) {
  McapWriter::Schema schema{topic.schema_name, topic.schema_encoding, topic.schema};
  if (topic.schema_encoding != "protobuf") return schema;
  schema.data = bytes_of_base64(topic.schema).value();
  return schema;
}

/// The topics of a scene that is fed with the messages of logs, into a file.
class SceneRecorder {
 public:
  SceneRecorder(const std::filesystem::path& file, const SceneParameters& parameters)
      : scene_(bus_, board_, parameters), writer_(file) {
    for (const Topic& topic : board_.topics()) {
      channels_.push_back(writer_.add_channel(topic.name, topic.encoding, schema_of(topic)));
    }
  }

  /// Events in order of time; one with a damaged time is skipped.
  void play(const LogEventView& event) {
    const bool gap = bus_.now_utime() != 0 && event.utime - bus_.now_utime() >= kGapMaxUs;
    if (!is_plausible_utime(event.utime) || gap) {
      ++skipped_;
      return;
    }
    if (event.utime >= write_utime_ + kWritePeriodUs) write_due(event.utime);
    bus_.inject(event.utime, event.channel, event.data);
  }

  /// Writes what has changed since it was written, too.
  McapExport close(const std::vector<std::filesystem::path>& logs) {
    write_changed();
    if (writer_.messages() == 0)
      throw std::runtime_error(
          fmt::format("no message for the viewer in {}", logs.front().string()));
    writer_.write({"adit", {{"version", version()}}});
    writer_.close();
    McapExport result{writer_.messages(), channels_.size(), {}};
    if (skipped_ > 0)
      result.warnings.push_back(fmt::format("skipped {} events with implausible times", skipped_));
    return result;
  }

 private:
  void write_due(std::int64_t utime) { write(utime, bus_.now_utime()); }

  /// `due_utime`: for the periods of the topics.
  void write(std::int64_t due_utime, std::int64_t log_utime) {
    write_utime_ = due_utime;
    const auto is_due = [&](TopicId topic) {
      const bool appended = board_.topics()[topic].retention == Retention::kAppended;
      return appended || due_utime >= next_utime_[topic];
    };
    for (const TopicBoard::Update& update : board_.take_due(due_utime, is_due)) {
      next_utime_[update.topic] =
          log_utime + static_cast<std::int64_t>(static_cast<double>(update.message.bytes->size()) /
                                                kTopicBytesPerUs);
      writer_.write(channels_[update.topic], log_utime, update.message.utime,
                    *update.message.bytes);
    }
  }

  void write_changed() { write(std::numeric_limits<std::int64_t>::max(), bus_.now_utime()); }

  MemoryBus bus_;
  TopicBoard board_;
  Scene scene_;
  McapWriter writer_;
  std::vector<std::uint16_t> channels_;  ///< by topic
  std::map<TopicId, std::int64_t> next_utime_;
  std::int64_t write_utime_ = 0;
  std::size_t skipped_ = 0;
};

void add_warnings(const LogHealth& health, const std::filesystem::path& log,
                  std::vector<std::string>& warnings) {
  const std::string name = log.filename().string();
  if (health.corrupt_bytes > 0)
    warnings.push_back(fmt::format("skipped {} corrupt bytes of {}", health.corrupt_bytes, name));
  if (health.truncated_bytes > 0) warnings.push_back(name + " is truncated within an event");
}

}  // namespace

McapExport export_mcap(const std::vector<std::filesystem::path>& given,
                       const std::filesystem::path& file, const SceneParameters& parameters,
                       const std::function<void(double)>& progress) {
  const std::vector<std::filesystem::path> logs = in_order_of_time(given);
  SceneRecorder recorder(file, parameters);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    LogFile log(logs[i]);
    std::size_t events = 0;
    while (const auto event = log.next()) {
      recorder.play(*event);
      if (++events % kEventsPerProgress != 0) continue;
      const double share = static_cast<double>(events) / static_cast<double>(log.size());
      progress((static_cast<double>(i) + share) / static_cast<double>(logs.size()));
    }
    add_warnings(log.health(), logs[i], warnings);
  }
  McapExport result = recorder.close(logs);
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  result.warnings = std::move(warnings);
  return result;
}

}  // namespace adit
