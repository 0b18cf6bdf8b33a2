// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/messages/result.hpp"

/// Foxglove's WebSocket protocol, as bytes: foxglove/ws-protocol docs/spec.md, and the playback
/// messages of the subprotocol foxglove.sdk.v1. Integers in binary messages are little-endian.
namespace adit::foxglove_protocol {

/// The subprotocols of the handshake, the preferred one first.
inline constexpr std::string_view kSubprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// A client asks for messages of channels.
struct Subscribe {
  struct Entry {
    std::uint32_t subscription = 0;  ///< chosen by the client
    std::uint32_t channel = 0;
  };
  std::vector<Entry> entries;
};

struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};

struct ServiceCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;  ///< chosen by the client, returned with the response
  std::string encoding;
  std::string payload;
};

/// Controls the playback of a log.
struct PlaybackControl {
  bool play = false;
  double speed = 1.0;
  std::optional<std::int64_t> seek_ns;  ///< time since the epoch
  std::string request_id;
};

/// A request of the protocol that this server does not offer, for example clientPublish.
struct Unsupported {
  std::string operation;
};

using Request = std::variant<Subscribe, Unsubscribe, ServiceCall, PlaybackControl, Unsupported>;

/// Entries of one message of a client; more are rejected.
inline constexpr std::size_t kEntriesMax = 1000;

Result<Request> parse_text(std::string_view text);
Result<Request> parse_binary(std::span<const std::uint8_t> bytes);

/// A channel as it is advertised.
struct Channel {
  std::uint32_t id = 0;
  std::string topic;
  std::string encoding;         ///< of the messages: json or protobuf
  std::string schema_name;      ///< e.g. foxglove.Grid
  std::string schema_encoding;  ///< jsonschema or protobuf
  std::string schema;           ///< JSON schema, or a FileDescriptorSet in base64
};

struct Service {
  std::uint32_t id = 0;
  std::string name;
  std::string request_schema;   ///< JSON schema
  std::string response_schema;  ///< JSON schema
};

struct ServerInfo {
  std::string name = {};
  std::vector<std::string> capabilities = {};
  std::vector<std::pair<std::string, std::string>> metadata = {};
  std::string session = {};  ///< differs after each start of the server
  /// First and last time of a log [ns since the epoch].
  std::optional<std::pair<std::int64_t, std::int64_t>> time_range = {};
};

enum class StatusLevel { kInfo = 0, kWarning = 1, kError = 2 };

enum class PlaybackStatus : std::uint8_t { kPlaying = 0, kPaused = 1, kBuffering = 2, kEnded = 3 };

struct PlaybackState {
  PlaybackStatus status = PlaybackStatus::kPaused;
  std::int64_t time_ns = 0;
  double speed = 1.0;
  std::string request_id;  ///< of the request that this answers; may be empty
};

// Messages of the server: text.
std::string server_info_text(const ServerInfo& info);
std::string advertise_text(const std::vector<Channel>& channels);
std::string advertise_services_text(const std::vector<Service>& services);
std::string status_text(StatusLevel level, std::string_view message);
std::string service_failure_text(const ServiceCall& call, std::string_view message);

// Messages of the server: binary.
/// The bytes before the payload of a message.
std::string message_header(std::uint32_t subscription, std::int64_t time_ns);
std::string time_message(std::int64_t time_ns);
std::string service_response(const ServiceCall& call, std::string_view json);
std::string playback_state_message(const PlaybackState& state);

}  // namespace adit::foxglove_protocol
