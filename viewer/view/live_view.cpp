// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/live_view.hpp"

#include <random>
#include <vector>

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

void run_live_view(const ViewerOptions& options, const std::string& lcm_url,
                   const std::optional<ViewerOrders>& orders, const StopSignal& stop,
                   const std::function<void(std::uint16_t)>& on_ready) {
  LcmBusOptions bus_options;
  bus_options.url = lcm_url;
  if (orders) bus_options.seal = orders->seal.read();
  LcmBus bus(bus_options);
  TopicBoard board;
  const Scene scene(bus, board, options.parameters.scene);
  std::optional<OrderService> order_service;
  foxglove_protocol::ServerInfo info{.name = "adit-viewer",
                                     .capabilities = {"time"},
                                     .metadata = {{"source", "live"},
                                                  {"title", options.title},
                                                  {"orders", orders ? "true" : "false"}},
                                     .session = new_session()};
  std::vector<foxglove_protocol::Service> services;
  ViewerServer::Handlers handlers;
  if (orders) {
    order_service.emplace(bus, orders->token, orders->control_process);
    info.capabilities.emplace_back("services");
    services = OrderService::services();
    handlers.on_service_call = [&](const foxglove_protocol::ServiceCall& call) {
      return order_service->call(call);
    };
  }
  TopicServer server(server_options(options), info, board, services, handlers);
  bus.create_wall_timer(kPollPeriodUs, [&](std::int64_t) { server.poll(scene.now_utime()); });
  on_ready(server.port());
  bus.run(stop.descriptor());
}

}  // namespace adit
