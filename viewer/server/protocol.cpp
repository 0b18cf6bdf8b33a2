// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/protocol.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include <nlohmann/json.hpp>

#include "common/files/little_endian.hpp"

namespace adit::foxglove_protocol {
namespace {

using nlohmann::json;

enum class ClientOpcode : std::uint8_t { kMessageData = 1, kServiceCall = 2, kPlaybackControl = 3 };
enum class ServerOpcode : std::uint8_t {
  kMessageData = 1,
  kTime = 2,
  kServiceResponse = 3,
  kPlaybackState = 5,
};

constexpr std::string_view kTooShort = "a binary message is too short";

/// Reads little-endian values from the front of a message.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// False if the message is shorter; the value is then unchanged.
  template <class T>
  bool read(T& value) {
    if (bytes_.size() < sizeof(T)) return false;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::uint64_t{bytes_[i]} << (8 * i);
    if constexpr (std::is_same_v<T, float>) {
      value = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    } else {
      value = static_cast<T>(bits);
    }
    bytes_ = bytes_.subspan(sizeof(T));
    return true;
  }

  /// A text behind its length of 4 bytes.
  bool read_text(std::string& text) {
    std::uint32_t length = 0;
    if (!read(length) || bytes_.size() < length) return false;
    text.assign(bytes_.begin(), bytes_.begin() + length);
    bytes_ = bytes_.subspan(length);
    return true;
  }

  [[nodiscard]] std::string rest() const { return {bytes_.begin(), bytes_.end()}; }

 private:
  std::span<const std::uint8_t> bytes_;
};

template <class T>
void append(std::string& bytes, T value) {
  if constexpr (std::is_same_v<T, float>) {
    append(bytes, std::bit_cast<std::uint32_t>(value));
  } else {
    append_little_endian(bytes, value);
  }
}

std::string begin_message(ServerOpcode opcode) {
  return {static_cast<char>(static_cast<std::uint8_t>(opcode))};
}

/// A non-negative number that fits 32 bits.
std::optional<std::uint32_t> id_in(const json& value) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto id = value.get<std::uint64_t>();
  if (id > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(id);
}

const json* array_in(const json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_array() || found->size() > kEntriesMax) return nullptr;
  return &*found;
}

Result<Request> parse_subscribe(const json& object) {
  const json* const entries = array_in(object, "subscriptions");
  if (!entries) return Rejected{"subscribe without a list of at most 1000 subscriptions"};
  Subscribe subscribe;
  for (const json& entry : *entries) {
    if (!entry.is_object() || !entry.contains("id") || !entry.contains("channelId"))
      return Rejected{"a subscription without id or channelId"};
    const auto subscription = id_in(entry["id"]);
    const auto channel = id_in(entry["channelId"]);
    if (!subscription || !channel) return Rejected{"a subscription with an invalid id"};
    subscribe.entries.push_back({*subscription, *channel});
  }
  return Request(std::move(subscribe));
}

Result<Request> parse_unsubscribe(const json& object) {
  const json* const ids = array_in(object, "subscriptionIds");
  if (!ids) return Rejected{"unsubscribe without a list of at most 1000 ids"};
  Unsubscribe unsubscribe;
  for (const json& value : *ids) {
    const auto id = id_in(value);
    if (!id) return Rejected{"unsubscribe with an invalid id"};
    unsubscribe.subscriptions.push_back(*id);
  }
  return Request(std::move(unsubscribe));
}

Result<Request> parse_service_call(Reader reader) {
  ServiceCall call;
  if (!reader.read(call.service) || !reader.read(call.call) || !reader.read_text(call.encoding))
    return Rejected{kTooShort};
  call.payload = reader.rest();
  return Request(std::move(call));
}

Result<Request> parse_playback_control(Reader reader) {
  std::uint8_t command = 0;
  float speed = 0.0F;
  std::uint8_t has_seek = 0;
  std::uint64_t seek_ns = 0;
  if (!reader.read(command) || !reader.read(speed) || !reader.read(has_seek) ||
      !reader.read(seek_ns))
    return Rejected{kTooShort};
  if (command > 1) return Rejected{"an unknown command of playback"};
  if (!std::isfinite(speed) || speed <= 0.0F)
    return Rejected{"a playback speed that is not positive"};
  if (seek_ns > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    return Rejected{"a playback time that is too large"};
  PlaybackControl control{.play = command == 0, .speed = speed, .seek_ns = {}, .request_id = {}};
  if (has_seek != 0) control.seek_ns = static_cast<std::int64_t>(seek_ns);
  reader.read_text(control.request_id);  // older clients send none
  return Request(std::move(control));
}

/// Text of any bytes as JSON; bytes that are not UTF-8 are replaced.
std::string text_of(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

Result<Request> parse_text(std::string_view text) {
  const json object = json::parse(text, nullptr, false);
  if (!object.is_object() || !object.contains("op") || !object["op"].is_string())
    return Rejected{"a text that is not a JSON object with op"};
  const auto& operation = object["op"].get_ref<const std::string&>();
  if (operation == "subscribe") return parse_subscribe(object);
  if (operation == "unsubscribe") return parse_unsubscribe(object);
  return Request(Unsupported{operation});
}

Result<Request> parse_binary(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
  std::uint8_t opcode = 0;
  if (!reader.read(opcode)) return Rejected{kTooShort};
  switch (static_cast<ClientOpcode>(opcode)) {
    case ClientOpcode::kServiceCall:
      return parse_service_call(reader);
    case ClientOpcode::kPlaybackControl:
      return parse_playback_control(reader);
    case ClientOpcode::kMessageData:
      return Request(Unsupported{"message data"});
  }
  return Rejected{"an unknown binary opcode"};
}

std::string server_info_text(const ServerInfo& info) {
  json object{{"op", "serverInfo"},
              {"name", info.name},
              {"capabilities", info.capabilities},
              {"supportedEncodings", {"json"}},
              {"sessionId", info.session}};
  for (const auto& [name, value] : info.metadata) object["metadata"][name] = value;
  if (info.time_range) {
    object["dataStartTime"] = info.time_range->first;
    object["dataEndTime"] = info.time_range->second;
  }
  return text_of(object);
}

std::string advertise_text(const std::vector<Channel>& channels) {
  json list = json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", channel.encoding},
                    {"schemaName", channel.schema_name},
                    {"schemaEncoding", channel.schema_encoding},
                    {"schema", channel.schema}});
  }
  return text_of({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string advertise_services_text(const std::vector<Service>& services) {
  json list = json::array();
  const auto schema = [](const std::string& name, const std::string& text) {
    return json{{"encoding", "json"},
                {"schemaName", name},
                {"schemaEncoding", "jsonschema"},
                {"schema", text}};
  };
  for (const Service& service : services) {
    list.push_back({{"id", service.id},
                    {"name", service.name},
                    {"type", service.name},
                    {"request", schema(service.name + "_request", service.request_schema)},
                    {"response", schema(service.name + "_response", service.response_schema)},
                    {"requestSchema", service.request_schema},
                    {"responseSchema", service.response_schema}});
  }
  return text_of({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

std::string status_text(StatusLevel level, std::string_view message) {
  return text_of({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string service_failure_text(const ServiceCall& call, std::string_view message) {
  return text_of({{"op", "serviceCallFailure"},
                  {"serviceId", call.service},
                  {"callId", call.call},
                  {"message", message}});
}

std::string message_header(std::uint32_t subscription, std::int64_t time_ns) {
  std::string bytes = begin_message(ServerOpcode::kMessageData);
  append(bytes, subscription);
  append(bytes, time_ns);
  return bytes;
}

std::string time_message(std::int64_t time_ns) {
  std::string bytes = begin_message(ServerOpcode::kTime);
  append(bytes, time_ns);
  return bytes;
}

std::string service_response(const ServiceCall& call, std::string_view json_text) {
  constexpr std::string_view kEncoding = "json";
  std::string bytes = begin_message(ServerOpcode::kServiceResponse);
  append(bytes, call.service);
  append(bytes, call.call);
  append(bytes, static_cast<std::uint32_t>(kEncoding.size()));
  return bytes.append(kEncoding).append(json_text);
}

std::string playback_state_message(const PlaybackState& state) {
  std::string bytes = begin_message(ServerOpcode::kPlaybackState);
  append(bytes, static_cast<std::uint8_t>(state.status));
  append(bytes, state.time_ns);
  append(bytes, static_cast<float>(state.speed));
  append(bytes, static_cast<std::uint32_t>(state.request_id.size()));
  return bytes.append(state.request_id);
}

}  // namespace adit::foxglove_protocol
