// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/mcap_export.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/version.hpp"
#include "common/text/base64.hpp"
#include "tools/export/mcap_writer.hpp"
#include "tools/export/replay_logs.hpp"
#include "viewer/scene/scene.hpp"

namespace adit {
namespace {

constexpr std::int64_t kWritePeriodUs = 10'000;  // topics have longer periods, or none
// A topic of large messages (map, volume) is written as rarely as keeps it below this rate, and at
// the end.
constexpr double kTopicBytesPerUs = 0.1;

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
    if (!is_playable_after(event.utime, bus_.now_utime())) {
      ++skipped_;
      return;
    }
    if (event.utime >= write_utime_ + kWritePeriodUs) write_due(event.utime);
    bus_.inject(event.utime, event.channel, event.data);
  }

  /// Writes what has changed since it was written, too.
  McapExport close(const std::vector<std::filesystem::path>& logs) {
    write(board_.take_changed());
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
  /// `utime`: for the periods of the topics.
  void write_due(std::int64_t utime) {
    write_utime_ = utime;
    write(board_.take_due(utime, [&](TopicId topic) {
      const bool appended = board_.topics()[topic].retention == Retention::kAppended;
      return appended || utime >= next_utime_[topic];
    }));
  }

  void write(const std::vector<TopicBoard::Update>& updates) {
    const std::int64_t log_utime = bus_.now_utime();
    for (const auto& [topic, message] : updates) {
      const auto bytes = static_cast<double>(message.bytes->size());
      next_utime_[topic] = log_utime + static_cast<std::int64_t>(bytes / kTopicBytesPerUs);
      writer_.write(channels_[topic], log_utime, message.utime, *message.bytes);
    }
  }

  MemoryBus bus_;
  TopicBoard board_;
  Scene scene_;
  McapWriter writer_;
  std::vector<std::uint16_t> channels_;  ///< by topic
  std::map<TopicId, std::int64_t> next_utime_;
  std::int64_t write_utime_ = 0;
  std::size_t skipped_ = 0;
};

}  // namespace

McapExport export_mcap(const std::vector<std::filesystem::path>& given,
                       const std::filesystem::path& file, const SceneParameters& parameters,
                       const std::function<void(double)>& progress) {
  const std::vector<std::filesystem::path> logs = in_order_of_time(given);
  SceneRecorder recorder(file, parameters);
  std::vector<std::string> warnings =
      replay_logs(logs, progress, [&](const LogEventView& event) { recorder.play(event); });
  McapExport result = recorder.close(logs);
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  result.warnings = std::move(warnings);
  return result;
}

}  // namespace adit
