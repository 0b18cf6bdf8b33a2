// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log/recording.hpp"

#include "common/bus/channels.hpp"
#include "common/files/file_error.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

Recording::Recording(const std::filesystem::path& path, double free_min_mb)
    : log_(path), space_(path, free_min_mb) {}

void Recording::write(const LogEventView& event) {
  if (!log_) return;
  try {
    log_->write(event);
  } catch (const FileError& error) {
    stop(error.what());
  }
}

void Recording::check_space(std::int64_t utime) {
  if (!log_) return;
  const std::string shortage = space_.shortage();
  if (shortage.empty()) return;
  stopped_ = "the recording has stopped: " + shortage;
  const LogEvent last = heartbeat(utime);
  write({last.utime, last.channel, last.data});
  close();
}

void Recording::stop(const std::string& reason) {
  stopped_ = "the recording has stopped: " + reason;
  close();
}

void Recording::close() {
  if (!log_) return;
  try {
    log_->close();
  } catch (const FileError& error) {
    if (stopped_.empty()) stopped_ = std::string("the recording is incomplete: ") + error.what();
  }
  log_.reset();
}

LogEvent Recording::heartbeat(std::int64_t utime) const {
  const Heartbeat heartbeat{utime, kStage, {Health::Level::kFault, stopped_}, 0, 0, 0};
  return {utime, std::string(channels::kHeartbeat), encode(to_message(heartbeat))};
}

}  // namespace adit
