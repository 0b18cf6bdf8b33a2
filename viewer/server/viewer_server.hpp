// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/messages/result.hpp"
#include "viewer/server/protocol.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

struct ViewerServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;  ///< 0: any
  /// A socket that listens already, instead of address and port; owned by the server.
  std::optional<int> listening_socket = {};
  /// Origins of pages that may connect, beside that of this server.
  std::vector<std::string> allowed_origins = {};
  std::string page = {};  ///< HTML of the address /
};

/// Opens a listening TCP socket, not inherited by other programs. Throws std::runtime_error.
int listen_on(const std::string& address, std::uint16_t port);

/// The port of a listening socket.
std::uint16_t port_of(int listening_socket);

/// Serves topics over Foxglove's WebSocket protocol, and the page over HTTP, at one port. All work
/// is done in `poll`, without blocking. No client can delay another one or the caller: each has a
/// bounded outbox (ClientOutbox), limits of size and time bound what it may send, and one that does
/// not answer a ping within half a minute is disconnected.
class ViewerServer {
 public:
  /// Connections at the same time; more are closed at once.
  static constexpr std::size_t kConnectionsMax = 100;

  struct Handlers {
    /// What a client that subscribes to a topic gets first.
    std::function<std::vector<TopicMessage>(TopicId)> on_subscribe = {};
    /// Answers a call in JSON, or rejects it.
    std::function<Result<std::string>(const foxglove_protocol::ServiceCall&)> on_service_call = {};
    /// Returns the state afterwards.
    std::function<foxglove_protocol::PlaybackState(const foxglove_protocol::PlaybackControl&)>
        on_playback = {};
  };

  /// Throws std::runtime_error if the port cannot be used. A missing handler is a missing
  /// capability; `info` must not state it.
  ViewerServer(const ViewerServerOptions& options, const foxglove_protocol::ServerInfo& info,
               std::vector<Topic> topics, const std::vector<foxglove_protocol::Service>& services,
               Handlers handlers);
  ~ViewerServer();
  ViewerServer(const ViewerServer&) = delete;
  ViewerServer& operator=(const ViewerServer&) = delete;

  /// Accepts, reads and writes what is possible now.
  void poll();

  /// Queues a message for all subscribers.
  void publish(TopicId topic, const TopicMessage& message);
  void publish_time(std::int64_t time_ns);
  /// To clients of foxglove.sdk.v1; the older subprotocol has no playback.
  void publish_playback_state(const foxglove_protocol::PlaybackState& state);

  [[nodiscard]] bool has_subscriber(TopicId topic) const;
  [[nodiscard]] std::size_t clients() const;
  /// The port in use.
  [[nodiscard]] std::uint16_t port() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace adit
