// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets for what clients of the viewer send: frames of the WebSocket protocol, and orders.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "tests/fuzz/targets.hpp"
#include "viewer/server/protocol.hpp"
#include "viewer/server/request_origin.hpp"
#include "viewer/view/order_service.hpp"

namespace adit::fuzz {
namespace {

namespace protocol = foxglove_protocol;

Bytes frame_of(std::string_view text) { return {text.begin(), text.end()}; }

std::string_view view_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A binary frame from parts that contain NUL.
Bytes binary_frame(std::uint8_t opcode, std::size_t zeros, std::string_view rest) {
  Bytes frame{opcode};
  frame.resize(1 + zeros);
  frame.insert(frame.end(), rest.begin(), rest.end());
  return frame;
}

/// Takes orders with the token of the samples.
struct Orders {
  MemoryBus bus;
  OrderService service{bus, "secret",
                       [](const std::string&, const std::string&) { return std::string(); }};

  /// The reason for rejection of a call of a service.
  std::string_view call(std::size_t index, std::string_view payload) {
    return service
        .call({.service = OrderService::services().at(index).id,
               .call = 1,
               .encoding = "json",
               .payload = std::string(payload)})
        .rejection();
  }
};

}  // namespace

std::vector<Target> viewer_targets() {
  constexpr const char* kOrder = R"({"token":"secret","order":"pause"})";
  constexpr const char* kProcess = R"({"token":"secret","action":"restart","process":"mapping"})";
  // The playback control has a speed of 1.0 behind opcode and command.
  Bytes playback = binary_frame(3, 5, std::string(9, '\0') + std::string("\1\0\0\0a", 5));
  playback[4] = 0x80;
  playback[5] = 0x3f;
  const auto orders = std::make_shared<Orders>();
  return {
      {"viewer_text_frame",
       {frame_of(
            R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2},{"id":3,"channelId":4}]})"),
        frame_of(R"({"op":"unsubscribe","subscriptionIds":[1,3]})"),
        frame_of(R"({"op":"advertise","channels":[{"id":1,"topic":"/a","encoding":"json"}]})")},
       [](std::span<const std::uint8_t> bytes) {
         return protocol::parse_text(view_of(bytes)).rejection();
       }},
      {"viewer_binary_frame",
       {binary_frame(2, 8, std::string("\4\0\0\0json{}", 10)), playback, binary_frame(1, 4, "{}")},
       [](std::span<const std::uint8_t> bytes) {
         return protocol::parse_binary(bytes).rejection();
       }},
      {"viewer_order",
       {frame_of(kOrder)},
       [orders](std::span<const std::uint8_t> bytes) { return orders->call(0, view_of(bytes)); }},
      {"viewer_process",
       {frame_of(kProcess)},
       [orders](std::span<const std::uint8_t> bytes) { return orders->call(1, view_of(bytes)); }},
      {"viewer_origin",
       {frame_of("http://127.0.0.1:8765\n127.0.0.1:8765"), frame_of("https://[::1]:80\n[::1]:80")},
       [](std::span<const std::uint8_t> bytes) -> std::string_view {
         const std::string_view text = view_of(bytes);
         const std::size_t line = std::min(text.find('\n'), text.size());
         const std::string_view host = text.substr(std::min(line + 1, text.size()));
         const bool allowed =
             is_own_host(host) && is_allowed_origin(text.substr(0, line), host, {});
         return allowed ? "" : "not allowed";
       }},
  };
}

}  // namespace adit::fuzz
