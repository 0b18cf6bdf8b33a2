// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/log_player.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/bus/log/lcm_log.hpp"
#include "common/messages/fields/quantities.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using foxglove_protocol::PlaybackControl;
using foxglove_protocol::PlaybackState;
using foxglove_protocol::PlaybackStatus;

constexpr std::size_t kEventsBetweenLooks = 64;
constexpr auto kWork = std::chrono::milliseconds(15);  // between answers to clients

}  // namespace

LogPlayer::LogPlayer(const std::vector<std::filesystem::path>& logs,
                     const SceneParameters& parameters)
    : parameters_(parameters) {
  for (const auto& path : logs) {
    logs_.push_back(std::make_unique<LogFile>(path));
    for (const LogEventView& event : logs_.back()->events()) {
      if (is_plausible_utime(event.utime)) events_.push_back(event);
    }
  }
  if (events_.empty())
    throw std::runtime_error(
        fmt::format("no message in {}", logs.empty() ? "no log" : quote(logs.front().string())));
  std::stable_sort(events_.begin(), events_.end(),
                   [](const LogEventView& a, const LogEventView& b) { return a.utime < b.utime; });
  restart();
  now_utime_ = from_utime_ = time_range().first;
}

std::pair<std::int64_t, std::int64_t> LogPlayer::time_range() const {
  return {events_.front().utime, events_.back().utime};
}

void LogPlayer::restart() {
  scene_.reset();
  board_ = std::make_unique<TopicBoard>();
  bus_ = std::make_unique<MemoryBus>();
  scene_ = std::make_unique<Scene>(*bus_, *board_, parameters_);
  next_ = 0;
}

PlaybackState LogPlayer::control(const PlaybackControl& control, std::int64_t wall_us) {
  const auto [first, last] = time_range();
  from_utime_ =
      control.seek_ns ? std::clamp(*control.seek_ns / 1000, first, last) : target_utime(wall_us);
  if (!control.seek_ns && behind_) from_utime_ = std::max(now_utime_, first);
  from_wall_us_ = wall_us;
  playing_ = control.play;
  speed_ = control.speed;
  PlaybackState state = this->state();
  if (control.seek_ns) state.time_ns = 1000 * from_utime_;
  state.request_id = control.request_id;
  return state;
}

PlaybackState LogPlayer::state() const {
  const bool ended = next_ == events_.size();
  const PlaybackStatus status = behind_     ? PlaybackStatus::kBuffering
                                : !playing_ ? PlaybackStatus::kPaused
                                : ended     ? PlaybackStatus::kEnded
                                            : PlaybackStatus::kPlaying;
  return {.status = status, .time_ns = 1000 * now_utime_, .speed = speed_, .request_id = {}};
}

std::int64_t LogPlayer::target_utime(std::int64_t wall_us) const {
  if (!playing_ || from_wall_us_ == 0) return from_utime_;
  const double played_us = speed_ * static_cast<double>(wall_us - from_wall_us_);
  const std::int64_t left_us = time_range().second - from_utime_;
  return played_us < static_cast<double>(left_us)
             ? from_utime_ + static_cast<std::int64_t>(played_us)
             : time_range().second;
}

bool LogPlayer::advance(std::int64_t wall_us) {
  if (from_wall_us_ == 0) from_wall_us_ = wall_us;
  const std::int64_t target = target_utime(wall_us);
  const bool back = target < now_utime_;
  if (back) restart();
  play_until(target);
  return back;
}

/// Whatever is not reached in this time is played at the next call. A log that cannot be played at
/// the desired speed continues from where it is.
void LogPlayer::play_until(std::int64_t utime) {
  const auto until = std::chrono::steady_clock::now() + kWork;
  behind_ = false;
  while (next_ < events_.size() && events_[next_].utime <= utime) {
    const LogEventView& event = events_[next_++];
    bus_->inject(event.utime, event.channel, event.data);
    now_utime_ = event.utime;
    if (next_ % kEventsBetweenLooks == 0 && std::chrono::steady_clock::now() > until) {
      behind_ = next_ < events_.size() && events_[next_].utime <= utime;
      break;
    }
  }
  if (!behind_) now_utime_ = utime;
}

}  // namespace adit
