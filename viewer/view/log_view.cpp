// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/log_view.hpp"

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "common/service/wall_time.hpp"
#include "viewer/view/log_player.hpp"
#include "viewer/view/topic_server.hpp"

namespace adit {
namespace {

using foxglove_protocol::PlaybackControl;

constexpr auto kPause = std::chrono::milliseconds(5);
constexpr std::int64_t kStatePeriodUs = 250'000;

/// The same for the same logs, so that a page keeps what it has when the viewer is restarted.
foxglove_protocol::ServerInfo info_of(const LogPlayer& player, const ViewerOptions& options) {
  const auto [first, last] = player.time_range();
  return {.name = "adit-viewer",
          .capabilities = {"time", "playbackControl"},
          .metadata = {{"source", "log"}, {"title", options.title}, {"orders", "false"}},
          .session = fmt::format("log-{}-{}", first, last),
          .time_range = std::pair(1000 * first, 1000 * last)};
}

}  // namespace

void run_log_view(const ViewerOptions& options, const std::vector<std::filesystem::path>& logs,
                  const StopSignal& stop, const std::function<void(std::uint16_t)>& on_ready) {
  LogPlayer player(logs, options.parameters.scene);
  TopicServer server(server_options(options), info_of(player, options), player.board(), {},
                     {.on_playback = [&player](const PlaybackControl& control) {
                       return player.control(control, steady_us());
                     }});
  on_ready(server.port());
  std::int64_t state_us = 0;
  bool begun = false;  // by the first client
  while (!stop.received()) {
    const std::int64_t now_us = steady_us();
    begun = begun || server.clients() > 0;
    if (begun && player.advance(now_us)) server.show(player.board());
    server.poll(player.now_utime());
    if (now_us >= state_us + kStatePeriodUs) {
      state_us = now_us;
      server.publish_playback_state(player.state());
    }
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace adit
