// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/live_view.hpp"

#include <random>

#include <fmt/format.h>

#include "common/bus/lcm_bus.hpp"
#include "viewer/scene/scene.hpp"
#include "viewer/server/topic_board.hpp"
#include "viewer/view/topic_server.hpp"

namespace adit {
namespace {

constexpr std::int64_t kPollPeriodUs = 10'000;

/// Differs after each start; not a secret.
std::string new_session() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

}  // namespace

void run_live_view(const ViewerOptions& options, const std::string& lcm_url, const StopSignal& stop,
                   const std::function<void(std::uint16_t)>& on_ready) {
  LcmBus bus({.url = lcm_url});
  TopicBoard board;
  const Scene scene(bus, board, options.parameters.scene);
  const foxglove_protocol::ServerInfo info{
      .name = "adit-viewer",
      .capabilities = {"time"},
      .metadata = {{"source", "live"}, {"title", options.title}, {"orders", "false"}},
      .session = new_session()};
  TopicServer server(server_options(options), info, board, {}, {});
  bus.create_wall_timer(kPollPeriodUs, [&](std::int64_t) { server.poll(scene.now_utime()); });
  on_ready(server.port());
  bus.run(stop.descriptor());
}

}  // namespace adit
