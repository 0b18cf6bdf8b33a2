// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viewer/server/protocol.hpp"
#include "viewer/server/topic_board.hpp"
#include "viewer/server/viewer_server.hpp"

namespace adit {

/// A server that sends the topics of a board.
class TopicServer {
 public:
  /// `board` must outlive this, or until `show` replaces it. `handlers`: all but `on_subscribe`.
  /// Throws as ViewerServer does.
  TopicServer(const ViewerServerOptions& options, const foxglove_protocol::ServerInfo& info,
              TopicBoard& board, const std::vector<foxglove_protocol::Service>& services,
              ViewerServer::Handlers handlers);
  TopicServer(const TopicServer&) = delete;
  TopicServer& operator=(const TopicServer&) = delete;

  /// Answers clients and sends what is due. `utime`: the time of the content [µs since the epoch].
  void poll(std::int64_t utime);

  /// Shows another board with the same topics from now on; clients get its content.
  void show(TopicBoard& board);

  void publish_playback_state(const foxglove_protocol::PlaybackState& state) {
    server_.publish_playback_state(state);
  }
  [[nodiscard]] std::size_t clients() const { return server_.clients(); }
  [[nodiscard]] std::uint16_t port() const { return server_.port(); }

 private:
  ViewerServer::Handlers with_board(ViewerServer::Handlers handlers);

  TopicBoard* board_;
  ViewerServer server_;
  std::int64_t time_wall_us_ = 0;  ///< when the time was sent last
};

}  // namespace adit
